// rollrig align as a laboratory meets it: an alignment, its files, and values that it is applied to.
#include <fmt/format.h>

#include <array>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <string>

#include "build_paths.h"
#include "tests/cli/longest_line.h"
#include "tests/support/run_program.h"

using Catch::Contains;
using nlohmann::json;
using rollrig::tests::flatten;
using rollrig::tests::longest_line;
using rollrig::tests::read_file;
using rollrig::tests::run_program;
using rollrig::tests::TemporaryFolder;
using rollrig::tests::write_file;

namespace {

const std::string kAlignmentExample = "'" ROLLRIG_SOURCE_DIR "/assets/examples/alignment.csv'";

/// Five tires of one laboratory, four measurements each, whose reference values lie on y = 0.95 x + 0.2. `last` is
/// added to each last measurement.
std::string make_alignment_csv(const std::string& columns, const std::string& value_column, double last = 0.0) {
  std::string text = "tire,class,date," + value_column + columns + "\n";
  for (int repeat = 0; repeat < 4; ++repeat) {
    for (int tire = 0; tire < 5; ++tire) {
      const double truth = 6.5 + tire;
      const double shift = repeat == 0 ? 0.2 : repeat == 1 ? -0.03 : repeat == 2 ? 0.0 : 0.03 + last;
      text += "T" + std::to_string(tire + 1) + ",C1,2026-0" + std::to_string(repeat + 3) + "-0" +
              std::to_string(tire + 2) + "," + std::to_string(truth + shift);
      if (!columns.empty()) text += "," + std::to_string(0.95 * truth + 0.2);
      text += "\n";
    }
  }
  return text;
}

}  // namespace

TEST_CASE("the example is aligned within 80 columns, and its numbers are those of the JSON", "[fast]") {
  const TemporaryFolder folder;
  const auto run = run_program(
      "align " + kAlignmentExample + " --reference-machine drum_A --reference 1.003 -0.05 --out out", folder.path());
  INFO(run.out << run.err);
  REQUIRE(run.status == 0);
  CHECK(longest_line(run.out) <= 80);
  const json alignment = json::parse(read_file(folder.file("out/alignment.json")));
  CHECK(alignment["format"] == "rollrig-alignment/1");
  CHECK(alignment["machine"] == "drum_B");
  CHECK(alignment["valid"] == true);
  // Made with A2 = 1/1.015 and B2 = -0.22/1.015.
  CHECK(alignment["line"]["A2"]["ci95"][0].get<double>() < 1.0 / 1.015);
  CHECK(alignment["line"]["A2"]["ci95"][1].get<double>() > 1.0 / 1.015);
  CHECK(alignment["sigma_m_N_per_kN"]["ci95"][0].get<double>() < 0.04);
  CHECK(alignment["sigma_m_N_per_kN"]["ci95"][1].get<double>() > 0.04);
  CHECK_THAT(read_file(folder.file("out/measurements.csv")), Catch::StartsWith("tire,class,machine,date,"));

  const auto value = run_program("align --apply out/alignment.json --rrc 8.1 --on 2026-06-01 --json -", folder.path());
  REQUIRE(value.status == 0);
  const json aligned = json::parse(value.out);
  const double at_reference =
      alignment["line"]["A2"]["value"].get<double>() * 8.1 + alignment["line"]["B2_N_per_kN"]["value"].get<double>();
  CHECK(aligned["aligned_N_per_kN"].get<double>() == Approx(1.003 * at_reference - 0.05));
  CHECK(aligned["sd_N_per_kN"].get<double>() > 1.003 * 0.9 * alignment["sigma_m_N_per_kN"]["value"].get<double>());
}

TEST_CASE("the first measurement of a tire is not used, and the line of the others is exact", "[fast]") {
  const TemporaryFolder folder;
  write_file(folder.file("tires.csv"), make_alignment_csv(",reference_N_per_kN", "rrc_N_per_kN"));
  const auto run = run_program("align tires.csv --json -", folder.path());
  INFO(run.err);
  REQUIRE(run.status == 0);
  const json alignment = json::parse(run.out);
  CHECK(alignment["line"]["A2"]["value"].get<double>() == Approx(0.95).epsilon(1e-9));
  CHECK(alignment["line"]["B2_N_per_kN"]["value"].get<double>() == Approx(0.2).epsilon(1e-6));
  CHECK(alignment["sigma_m_N_per_kN"]["value"].get<double>() == Approx(0.03));
  CHECK(alignment["valid_until"] == "2028-06-06");
  const json kept = json::parse(run_program("align tires.csv --first-excluded --json -", folder.path()).out);
  CHECK(kept["line"]["B2_N_per_kN"]["value"].get<double>() == Approx(0.2 - 0.95 * 0.05).epsilon(1e-6));
}

TEST_CASE("kg/t is N/kN", "[fast]") {
  const TemporaryFolder folder;
  write_file(folder.file("tires.csv"), make_alignment_csv(",reference_N_per_kN", "rrc_N_per_kN"));
  write_file(folder.file("tonnes.csv"), make_alignment_csv(",reference_N_per_kN", "rrc_kg_per_t"));
  json one = json::parse(run_program("align tires.csv --json -", folder.path()).out);
  json other = json::parse(run_program("align tonnes.csv --json -", folder.path()).out);
  one.erase("file");
  other.erase("file");
  CHECK(one == other);
}

TEST_CASE("a machine of too large a sigma_m is told how often to measure", "[fast]") {
  const TemporaryFolder folder;
  write_file(folder.file("tires.csv"), make_alignment_csv(",reference_N_per_kN", "rrc_N_per_kN", 0.2));
  const auto run = run_program("align tires.csv --json -", folder.path());
  CHECK(run.status == 1);
  const json alignment = json::parse(run.out);
  // -0.03, 0, 0.23: standard deviation 0.1422; 1 + (0.1422/0.043)^2 = 11.9.
  CHECK(alignment["sigma_m_N_per_kN"]["value"].get<double>() == Approx(0.1422).epsilon(1e-3));
  CHECK(alignment["measurements_needed"] == 12);
  CHECK(alignment["valid"] == false);
}

TEST_CASE("an alignment ends with two years, a change of the machine or a drift", "[fast]") {
  const TemporaryFolder folder;
  std::string text = make_alignment_csv(",reference_N_per_kN", "rrc_N_per_kN");
  write_file(folder.file("tires.csv"), text);
  CHECK(run_program("align tires.csv --on 2028-06-06", folder.path()).status == 0);
  const auto late = run_program("align tires.csv --on 2028-06-07", folder.path());
  CHECK(late.status == 1);
  CHECK_THAT(flatten(late.out), Contains("the alignment was valid until 2028-06-06"));
  const auto changed = run_program("align tires.csv --machine-changed 2026-09-01", folder.path());
  CHECK(changed.status == 1);
  CHECK_THAT(flatten(changed.out), Contains("the machine was changed on 2026-09-01"));
  CHECK(run_program("align tires.csv --machine-changed 2026-01-31", folder.path()).status == 0);

  text.insert(text.find('\n'), ",use");
  std::size_t at = text.find('\n') + 1;
  while ((at = text.find('\n', at)) != std::string::npos) {
    text.insert(at, ",");
    at += 2;
  }
  for (int month = 1; month <= 12; ++month) {
    const std::string two = (month < 10 ? "0" : "") + std::to_string(month);
    text += "K1,C1,2026-" + two + "-15," + std::to_string(8.0 + 0.02 * month + (month % 2 == 0 ? 0.01 : -0.01)) +
            ",,control\n";
  }
  write_file(folder.file("drift.csv"), text);
  const auto drift = run_program("align drift.csv", folder.path());
  INFO(drift.out << drift.err);
  CHECK(drift.status == 1);
  CHECK_THAT(flatten(drift.out), Contains("the control tires drift by +0.2"));
}

TEST_CASE("a set that breaks rules is aligned on demand, but is not valid", "[fast]") {
  const auto run =
      run_program("align '" ROLLRIG_SOURCE_DIR "/tests/bad_input/align_four_tires.csv' --preliminary --json -");
  INFO(run.out << run.err);
  CHECK(run.status == 1);
  const json alignment = json::parse(run.out);
  CHECK(alignment["valid"] == false);
  CHECK(alignment["checks"][0]["name"] == "alignment tires");
  CHECK(alignment["checks"][0]["met"] == false);
}

TEST_CASE("measurements that are all copies of one another are doubted", "[fast]") {
  const TemporaryFolder folder;
  std::string text = "tire,class,date,rrc_N_per_kN,reference_N_per_kN\n";
  for (const char* month : {"03", "04", "05", "06"}) {
    int tire = 0;
    for (const char* rrc : {"6.31", "7.17", "8.43", "9.59", "10.71"}) {
      ++tire;
      text += fmt::format("T{0},C1,2026-{1}-{0:02},{2},{2}\n", tire, month, rrc);
    }
  }
  write_file(folder.file("copied.csv"), text);
  const auto run = run_program("align copied.csv", folder.path());
  INFO(run.err);
  CHECK_THAT(flatten(run.out), Contains("all measurements of each tire are equal: real measurements scatter"));
}

TEST_CASE("values that are those of the reference machine are doubted in text, JSON and certificate", "[fast]") {
  const TemporaryFolder folder;
  std::string text = "tire,class,date,machine,rrc_N_per_kN\n", own = text;
  const std::array<double, 4> scatter{0.07, -0.03, 0.02, 0.04};
  for (const char* machine : {"drum_B", "drum_A"}) {
    for (int repeat = 0; repeat < 4; ++repeat) {
      for (int tire = 1; tire <= 5; ++tire) {
        const double rrc = 5.5 + 1.01 * tire + scatter[static_cast<std::size_t>((repeat + tire) % 4)];
        const bool is_candidate = std::string(machine) == "drum_B";
        const std::string row =
            fmt::format("T{0},C1,2025-0{1}-{2:02},{3},", tire, is_candidate ? 3 : 4, 7 * repeat + tire, machine);
        text += fmt::format("{}{:.2f}\n", row, rrc);
        own += fmt::format("{}{:.2f}\n", row, is_candidate ? 1.02 * rrc + 0.1 : rrc);
      }
    }
  }
  write_file(folder.file("copied.csv"), text);
  write_file(folder.file("own.csv"), own);
  const auto run = run_program(
      "align copied.csv --reference-machine drum_A --reference 1 0 --json a.json --report a.html", folder.path());
  INFO(run.out << run.err);
  const std::string doubt = "15 of the 15 used values of machine 'drum_B' are equal to values of the same tire";
  CHECK_THAT(flatten(run.out), Contains(doubt) && !Contains("same values"));
  CHECK_THAT(json::parse(read_file(folder.file("a.json")))["warnings"].dump(), Contains(doubt));
  CHECK_THAT(flatten(read_file(folder.file("a.html"))), Contains("15 of the 15 used values of machine"));
  const auto other = run_program("align own.csv --reference-machine drum_A", folder.path());
  CHECK_THAT(flatten(other.out), Contains("sigma_m of the machine") && !Contains("copied"));
}

TEST_CASE("dates after today are doubted, by the day more that clocks may be ahead", "[fast]") {
  const TemporaryFolder folder;
  write_file(folder.file("tires.csv"), make_alignment_csv(",reference_N_per_kN", "rrc_N_per_kN"));
  const auto align_on = [&](const char* epoch_s) {
    return flatten(run_program("align tires.csv", folder.path(), std::string("SOURCE_DATE_EPOCH=") + epoch_s).out);
  };
  // The last measurements are those of 2026-06-05 and 2026-06-06.
  CHECK_THAT(align_on("1780531200"),
             Contains("1 measurement is dated after today, 2026-06-04, the last on 2026-06-06"));
  CHECK_THAT(align_on("1780617600"), Contains("valid on 2026-06-06") && !Contains("after today"));
  CHECK_THAT(align_on("1735689600"), Contains("20 measurements are dated after today, 2025-01-01"));
  CHECK_THAT(align_on("253402300799"), Contains("valid on 2026-06-06") && !Contains("after today"));
}

TEST_CASE("tires whose class is hardly theirs are doubted", "[fast]") {
  const TemporaryFolder folder;
  const auto align_tires = [&](const char* tire_class, double least, double step) {
    std::string text = "tire,class,date,rrc_N_per_kN,reference_N_per_kN\n";
    for (int repeat = 1; repeat <= 4; ++repeat) {
      for (int tire = 0; tire < 5; ++tire) {
        const double truth = least + step * tire;
        text += fmt::format("T{0},{1},2025-0{2}-0{3},{4:.3f},{5:.3f}\n", tire, tire_class, repeat, tire + 1,
                            truth + 0.013 * repeat + 0.011 * ((tire + repeat) % 3), truth);
      }
    }
    write_file(folder.file("tires.csv"), text);
    const auto run = run_program("align tires.csv", folder.path());
    INFO(run.err);
    CHECK(run.status == 0);
    return flatten(run.out);
  };
  CHECK_THAT(align_tires("C3", 6.1, 1.075),
             Contains("the tires of class C3 have a mean RRc of") && Contains("above 8 N/kN, the limit of UN R117"));
  CHECK_THAT(align_tires("C1", 15.03, 2.0), Contains("above 12 N/kN") && Contains("is the class right?"));
  CHECK_THAT(align_tires("C1", 2.0, 0.825), Contains("below 3.9 N/kN, 0.6 times the upper bound of label class A"));
  CHECK_THAT(align_tires("C3", 4.0, 0.8), !Contains("is the class right?"));
  CHECK_THAT(align_tires("C2", 6.03, 1.0), !Contains("is the class right?"));
}

TEST_CASE("a value outside the tires, and one of an alignment that is not valid, have their warning", "[fast]") {
  const TemporaryFolder folder;
  write_file(folder.file("tires.csv"), make_alignment_csv(",reference_N_per_kN", "rrc_N_per_kN"));
  CHECK(run_program("align tires.csv --on 2030-01-01 --json late.json", folder.path()).status == 1);
  const auto run = run_program("align --apply late.json --rrc 13.2", folder.path());
  CHECK(run.status == 1);
  CHECK_THAT(flatten(run.out), Contains("extrapolated") && Contains("not valid"));
}

TEST_CASE("an alignment that is over is doubted where it is applied, by today or by the day that is given", "[fast]") {
  const TemporaryFolder folder;
  write_file(folder.file("tires.csv"), make_alignment_csv(",reference_N_per_kN", "rrc_N_per_kN"));
  REQUIRE(run_program("align tires.csv --json a.json", folder.path()).status == 0);
  const std::string until = json::parse(read_file(folder.file("a.json")))["valid_until"];
  const std::string last = json::parse(read_file(folder.file("a.json")))["last_measurement"];
  const auto apply = [&](int status, const std::string& options, const std::string& before = "") {
    const auto run = run_program("align --apply a.json --rrc 8.1 " + options, folder.path(), before);
    CHECK(run.status == status);
    return flatten(run.out);
  };
  CHECK_THAT(apply(0, "--on " + until), !Contains("was valid until"));
  CHECK_THAT(apply(0, "--on " + last), !Contains("does not hold"));
  CHECK_THAT(apply(1, "--on 2049-01-01"), Contains("was valid until " + until + ", which is before 2049-01-01"));
  CHECK_THAT(apply(1, "", "SOURCE_DATE_EPOCH=2500000000"), Contains("which is before 2049-03-22"));
  CHECK_THAT(apply(1, "--on 2020-01-01"), Contains("the alignment was measured until " + last));
}

TEST_CASE("the certificate has the numbers of the JSON, the hash of its file, and room for signatures", "[fast]") {
  const TemporaryFolder folder;
  const auto run = run_program(
      "align " + kAlignmentExample + " --reference-machine drum_A --report certificate.html --json alignment.json",
      folder.path());
  INFO(run.err);
  REQUIRE(run.status == 0);
  const std::string page = read_file(folder.file("certificate.html"));
  const json alignment = json::parse(read_file(folder.file("alignment.json")));
  const std::string A2 = std::to_string(alignment["line"]["A2"]["value"].get<double>()).substr(0, 5);
  CHECK_THAT(page, Contains("data-json=\"/line/A2/value\">" + A2) && Contains("Signature") &&
                       Contains("data-json=\"/valid_until\">2027-"));
  CHECK_THAT(page, !Contains("<script"));
}

TEST_CASE("an alignment and a value on it have a budget and Monte Carlo, which change nothing else", "[fast]") {
  const TemporaryFolder folder;
  const std::string fit =
      "align " + kAlignmentExample + " --reference-machine drum_A --reference 1.003 -0.05 --quiet --force --out ";
  REQUIRE(run_program(fit + "plain", folder.path()).status == 0);
  REQUIRE(run_program(fit + "one --monte-carlo 2000 --threads 1", folder.path()).status == 0);
  REQUIRE(run_program(fit + "two --monte-carlo 2000 --threads 3", folder.path()).status == 0);
  CHECK(read_file(folder.file("one/alignment.json")) == read_file(folder.file("two/alignment.json")));
  json more = json::parse(read_file(folder.file("one/alignment.json")));
  const json budgets = more["uncertainty"]["budgets"];
  CHECK(budgets[0]["key"] == "A2");
  CHECK(budgets[0]["combined_standard_uncertainty"].get<double>() ==
        Approx(more["line"]["A2"]["sd"].get<double>()).epsilon(0.01));
  more.erase("uncertainty");
  CHECK(more == json::parse(read_file(folder.file("plain/alignment.json"))));

  const std::string apply = "align --apply plain/alignment.json --rrc 8.1 --on 2026-06-01 --json - ";
  const json value = json::parse(run_program(apply, folder.path()).out);
  const json uncertain = json::parse(run_program(apply + "--monte-carlo 20000", folder.path()).out);
  const json& budget = uncertain["uncertainty"]["budgets"][0];
  CHECK(budget["value"].get<double>() == Approx(value["aligned_N_per_kN"].get<double>()));
  CHECK(budget["combined_standard_uncertainty"].get<double>() == Approx(value["sd_N_per_kN"].get<double>()));
  const auto text =
      run_program("align --apply plain/alignment.json --rrc 8.1 --on 2026-06-01 --monte-carlo 300", folder.path());
  CHECK(text.status == 0);
  CHECK(longest_line(text.out) <= 80);
  CHECK_THAT(text.out, Contains("Monte Carlo beside the GUM, 300 trials"));
}

TEST_CASE("an alignment does not hold before the last measurement of either machine", "[fast]") {
  const TemporaryFolder folder;
  std::string text = read_file(ROLLRIG_SOURCE_DIR "/assets/examples/alignment.csv");
  text.erase(text.find("K1,C1"));
  write_file(folder.file("tires.csv"), text);
  const std::string fit = "align tires.csv --reference-machine drum_A --reference 1 0 ";
  const auto run = run_program(fit + "--json a.json", folder.path());
  CHECK(run.status == 0);
  CHECK_THAT(flatten(run.out), Contains("valid on 2025-04-04"));
  CHECK(json::parse(read_file(folder.file("a.json")))["valid_from"] == "2025-04-04");
  const auto early = run_program(fit + "--on 2025-03-20", folder.path());
  CHECK(early.status == 2);
  CHECK_THAT(early.err, Contains("2025-04-04 or later"));
  const auto applied = run_program("align --apply a.json --rrc 8.1 --on 2025-03-20", folder.path());
  CHECK(applied.status == 1);
  CHECK_THAT(flatten(applied.out), Contains("the alignment was measured until 2025-04-04"));
}

TEST_CASE("control tires that were not measured for long are doubted, also where the alignment is applied", "[fast]") {
  const TemporaryFolder folder;
  const std::string fit = "align " + kAlignmentExample + " --reference-machine drum_A --reference 1 0 ";
  CHECK_THAT(flatten(run_program(fit, folder.path()).out), !Contains("warning"));
  const auto late = run_program(fit + "--on 2027-02-28 --json a.json", folder.path());
  CHECK_THAT(flatten(late.out), Contains("control tire 'K1': days between measurements: 384 at most, until 2027-02-28; "
                                         "expected <= 31"));
  const auto apply = [&](const std::string& day) {
    return flatten(run_program("align --apply a.json --rrc 8.1 --on " + day, folder.path()).out);
  };
  CHECK_THAT(apply("2026-03-01"), !Contains("control measurements"));
  CHECK_THAT(apply("2026-06-01"), Contains("control measurements until 2026-02-09, 112 days before 2026-06-01"));
}

TEST_CASE("a line that changes values by more than machines differ is doubted", "[fast]") {
  const auto align = [](const std::string& reference) {
    return flatten(
        run_program("align " + kAlignmentExample + " --reference-machine drum_A --reference " + reference).out);
  };
  CHECK_THAT(align("1.003 -0.05"), !Contains("change RRc by"));
  CHECK_THAT(align("0.95 0.6"), !Contains("change RRc by"));
  for (const char* absurd : {"1.003 5", "1.9 -4", "2 0", "0.79 2.5"}) {
    INFO(absurd);
    CHECK_THAT(align(absurd), Contains("change RRc by") && Contains("A1 = "));
  }
}

TEST_CASE("a value is aligned with the line of its class, and a file that was changed by hand is refused", "[fast]") {
  const TemporaryFolder folder;
  const std::string fit = "align " + kAlignmentExample + " --reference-machine drum_A --reference 1.003 -0.05 --quiet ";
  REQUIRE(run_program(fit + "--json a.json", folder.path()).status == 0);
  const std::string apply = "align --apply a.json --rrc 7.0 --on 2026-02-20 ";
  const auto of_none = run_program(apply, folder.path());
  CHECK_THAT(of_none.out, Contains("classes C1, C2"));
  CHECK(run_program(apply + "--class C2", folder.path()).status == 0);
  const auto of_C3 = run_program(apply + "--class C3", folder.path());
  CHECK(of_C3.status == 2);
  CHECK_THAT(of_C3.err, Contains("the alignment does not hold for class C3") && Contains("C1, C2"));
  CHECK(run_program(apply + "--class C4", folder.path()).status == 2);
  // The least value of the tires, 6.933, as it is shown.
  CHECK_THAT(flatten(run_program("align --apply a.json --rrc 6.93 --on 2026-02-20", folder.path()).out),
             !Contains("extrapolated"));
  const json made = json::parse(read_file(folder.file("a.json")));
  const auto refuse = [&](json changed, const std::string& key) {
    write_file(folder.file("b.json"), changed.dump());
    const auto run = run_program("align --apply b.json --rrc 7.0 --on 2026-02-20", folder.path());
    CHECK(run.status == 2);
    CHECK_THAT(flatten(run.err), Contains("was the file changed by hand?") && Contains(key));
  };
  json changed = made;
  changed["A1"] = 1.103;
  refuse(changed, "aligned.factor");
  changed = made;
  changed["valid_until"] = "2037-02-28";
  refuse(changed, "valid_until");
}

TEST_CASE("an aligned value has one expanded uncertainty in text, JSON and budget", "[fast]") {
  const TemporaryFolder folder;
  const std::string fit = "align " + kAlignmentExample + " --reference-machine drum_A --reference 1 0 --uncertainty ";
  REQUIRE(run_program(fit + "--json a.json", folder.path()).status == 0);
  const json made = json::parse(read_file(folder.file("a.json")));
  for (std::size_t i = 0; i < 3; ++i) {
    const double stated = made["aligned_examples"][i]["expanded_of_one_N_per_kN"];
    CHECK(made["uncertainty"]["budgets"][i + 2]["expanded_uncertainty"].get<double>() == Approx(stated).epsilon(2e-3));
  }
  const std::string apply = "align --apply a.json --rrc 8.96 --on 2026-02-20 --uncertainty --json -";
  const json value = json::parse(run_program(apply, folder.path()).out);
  const double half = value["coverage_factor"].get<double>() * value["sd_N_per_kN"].get<double>();
  CHECK(value["uncertainty"]["budgets"][0]["expanded_uncertainty"].get<double>() == Approx(half).epsilon(2e-3));
}

TEST_CASE("rows of a machine that is written in another way are named by their lines", "[fast]") {
  const TemporaryFolder folder;
  std::string text = read_file(ROLLRIG_SOURCE_DIR "/assets/examples/alignment.csv");
  const std::string fit = " --machine drum_B --reference-machine drum_A --reference 1 0";
  CHECK_THAT(flatten(run_program("align " + kAlignmentExample + fit).out), !Contains("not used, "));
  for (std::size_t at = text.find("K1,C1"); at != std::string::npos; at = text.find("K1,C1", at + 1)) {
    text.replace(text.find("drum_B", at), 6, "drum-B");
  }
  write_file(folder.file("tires.csv"), text);
  const auto run = run_program("align tires.csv" + fit, folder.path());
  INFO(run.out << run.err);
  CHECK_THAT(flatten(run.out), Contains("rows of machine 'drum-B' are not used, ") && Contains("of a control tire: line") &&
                                   Contains("Is the machine 'drum_B'?"));
}

TEST_CASE("a file whose lines end with CR alone says so", "[fast]") {
  const TemporaryFolder folder;
  std::string text = read_file(ROLLRIG_SOURCE_DIR "/assets/examples/alignment.csv");
  for (char& c : text) c = c == '\n' ? '\r' : c;
  write_file(folder.file("tires.csv"), text);
  const auto run = run_program("align tires.csv --reference-machine drum_A", folder.path());
  CHECK(run.status == 2);
  CHECK_THAT(flatten(run.err), Contains("the lines of this file end with a carriage return (CR) alone"));
}

TEST_CASE("an option without a text, or without what it belongs to, is refused", "[fast]") {
  for (const char* command :
       {"align tires.csv --on ''", "label --rrc 8.4 --class ''", "label --rrc 8.4 --class C1 --load-index ''"}) {
    const auto run = run_program(command);
    INFO(command << run.err);
    CHECK(run.status == 2);
    CHECK_THAT(run.err, Contains("is empty"));
  }
  CHECK(run_program("export c3_315_80r22_5 --vecto - --tires 4").status == 2);
  CHECK(run_program("export c3_315_80r22_5 --vecto - --tire-radius 0.5").status == 2);
}

TEST_CASE("the certificate has the last measurement of each machine and the day from which it holds", "[fast]") {
  const TemporaryFolder folder;
  const auto run =
      run_program("align " + kAlignmentExample + " --reference-machine drum_A --report a.html --json a.json", folder.path());
  const std::string page = read_file(folder.file("a.html"));
  const json alignment = json::parse(read_file(folder.file("a.json")));
  for (const char* key : {"last_measurement", "last_measurement_of_reference", "valid_from"}) {
    CHECK_THAT(page, Contains("data-json=\"/" + std::string(key) + "\">" + alignment[key].get<std::string>()));
  }
}
