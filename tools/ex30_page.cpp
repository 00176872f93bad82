#include <algorithm>
#include <cmath>

#include "tools/multi_cycle.h"
#include "tools/pages.h"

namespace rollrig::tools {
namespace {

using Sections = std::vector<SimulatedSection>;
using Certificate = std::vector<CertificateSection>;
using fmt::literals::operator""_a;

constexpr double kWhPerKm = 1e3 / 3600.0;  // from J/m
constexpr std::size_t kColdCity = 0;
constexpr std::size_t kSecondCity = 2;
constexpr std::size_t kThirdCity = 4;

double deviation_percent(const SimulatedSection& simulated, const CertificateSection& given, double efficiency) {
  return 100.0 * (simulated.per_m(efficiency) / given.per_m() - 1.0);
}

/// How much more a section takes over its distance than another.
double excess(const Certificate& certificate, std::size_t section, std::size_t other) {
  return certificate[section].per_m() / certificate[other].per_m() - 1.0;
}

/// What is left, at most, of the sections that are predicted; the cold one apart.
double find_largest_percent(const Sections& simulated, const Certificate& certificate, double efficiency) {
  double largest = 0.0;
  for (std::size_t i = 1; i < certificate.size(); ++i) {
    largest = std::max(largest, std::abs(deviation_percent(simulated[i], certificate[i], efficiency)));
  }
  return largest;
}

Rows list_certified_sections(const Sections& simulated, const Certificate& certificate, double efficiency) {
  Rows rows;
  for (std::size_t i = 0; i < certificate.size(); ++i) {
    const char* role = i == 0 ? "cold, apart" : (i == 2 || i == 3) ? "fitted" : "predicted";
    rows.push_back(fmt::format("| {} {} | {:.2f} | {:.2f} | {:+.2f} | {} |", certificate[i].phase, certificate[i].kind,
                               kWhPerKm * certificate[i].per_m(), kWhPerKm * simulated[i].per_m(efficiency),
                               deviation_percent(simulated[i], certificate[i], efficiency), role));
  }
  return rows;
}

/// Of every two sections, how well one efficiency from them does: the largest deviation.
std::vector<double> try_pairs(const Sections& simulated, const Certificate& certificate) {
  std::vector<double> largest;
  for (std::size_t i = 1; i < certificate.size(); ++i) {
    for (std::size_t j = i + 1; j < certificate.size(); ++j) {
      largest.push_back(find_largest_percent(simulated, certificate, fit_efficiency(simulated, certificate, {i, j})));
    }
  }
  return largest;
}

/// Deviations by totals, where the driver's miles differ from the cycle's.
Rows list_totals(const Sections& simulated, const Certificate& certificate, double efficiency) {
  Rows totals;
  for (std::size_t i = 1; i < certificate.size(); ++i) {
    const double whole_J = simulated[i].per_m(efficiency) * simulated[i].distance_m;
    totals.push_back(fmt::format("{:+.2f}", 100.0 * (whole_J / certificate[i].battery_J - 1.0)));
  }
  return totals;
}

Rows list_cold_sections(const Certificate& certificate, double efficiency) {
  const std::vector<MultiCycleTest> tests{{"volvo_ex30", 5.5, 0.0},
                                          {"volvo_ex30", 6.5, 0.0},
                                          {"volvo_ex30", 7.7, 0.0},
                                          {"volvo_ex30", 9.0, 0.0},
                                          {"volvo_ex30", 6.5, 14.0}};
  Rows rows;
  for (const MultiCycleTest& test : tests) {
    const Sections simulated = simulate_multi_cycle(test, certificate);
    const double own = simulated[kColdCity].per_m(efficiency) / simulated[kThirdCity].per_m(efficiency) - 1.0;
    const double own_second = simulated[kColdCity].per_m(efficiency) / simulated[kSecondCity].per_m(efficiency) - 1.0;
    rows.push_back(fmt::format("| {:.1f} N/kN | {} | {:.2f} | {:.2f} | {:.2f} |", test.rrc_N_per_kN,
                               test.driveline_cold_N > 0.0 ? fmt::format("{:.0f} N", test.driveline_cold_N) : "none",
                               100.0 * own, own / excess(certificate, kColdCity, kThirdCity), 100.0 * own_second));
  }
  return rows;
}

}  // namespace

std::string make_ex30_page() {
  const Certificate certificate = read_certificate(fmt::format("{}/ex30_multi_cycle/phases.csv", kPublishedFolder));
  const Sections simulated = simulate_multi_cycle({}, certificate);
  const double efficiency = fit_efficiency(simulated, certificate, {2, 3});
  const std::vector<double> pairs = try_pairs(simulated, certificate);
  const auto [best, worst] = std::minmax_element(pairs.begin(), pairs.end());
  return fill_page(
      "ex30", "sections"_a = join(list_certified_sections(simulated, certificate, efficiency)),
      "efficiency"_a = efficiency, "largest_percent"_a = find_largest_percent(simulated, certificate, efficiency),
      "pairs"_a = pairs.size(), "pairs_best"_a = *best, "pairs_worst"_a = *worst,
      "pairs_within"_a = std::count_if(pairs.begin(), pairs.end(), [](double percent) { return percent <= 3.0; }),
      "city_percent"_a = 100.0 * excess(certificate, kSecondCity, kThirdCity),
      "highway_percent"_a = 100.0 * excess(certificate, 1, 5),
      "totals"_a = fmt::join(list_totals(simulated, certificate, efficiency), ", "),
      "cold_percent"_a = 100.0 * excess(certificate, kColdCity, kThirdCity),
      "cold_second_percent"_a = 100.0 * excess(certificate, kColdCity, kSecondCity),
      "cold"_a = join(list_cold_sections(certificate, efficiency)));
}

}  // namespace rollrig::tools
