#include "diagnosis/terms/hypothesis.h"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

#include "sim/core/units.h"

using namespace rollrig;
using diagnosis::Hypothesis;
using diagnosis::SignedTerm;
using models::EffectParameter;

namespace {

/// Every parameter of the catalog, with each sign that it may have.
void for_each_parameter(const std::function<void(const EffectParameter& parameter, int sign)>& act) {
  for (const models::Effect* effect : models::all_effects()) {
    for (std::size_t i = 0; i < effect->info.parameters.size(); ++i) {
      const std::vector<int> signs =
          i == 0 ? diagnosis::possible_signs(effect->info.parameters.front()) : std::vector<int>{1};
      for (const int sign : signs) {
        INFO(effect->info.id << "." << effect->info.parameters[i].key << ", sign " << sign);
        act(effect->info.parameters[i], sign);
      }
    }
  }
}

double in_key_unit(const EffectParameter& parameter, double value_SI) {
  return value_SI / unit_of_key(parameter.key).factor;
}

SignedTerm on(const char* id, int sign = 1) { return {&diagnosis::find_term(id), sign}; }

}  // namespace

TEST_CASE("one prior unit to either side of the middle lie the prior's low and high", "[fast]") {
  for_each_parameter([](const EffectParameter& parameter, int sign) {
    const double low = in_key_unit(parameter, diagnosis::from_prior_units(parameter, -1.0, sign).value_SI);
    const double high = in_key_unit(parameter, diagnosis::from_prior_units(parameter, 1.0, sign).value_SI);
    CHECK(low == Approx(sign * parameter.prior.low));
    CHECK(high == Approx(sign * parameter.prior.high));
  });
}

TEST_CASE("a value in prior units comes back", "[fast]") {
  for_each_parameter([](const EffectParameter& parameter, int sign) {
    for (const double u : {-0.9, 0.0, 0.7}) {
      const double value_SI = diagnosis::from_prior_units(parameter, u, sign).value_SI;
      CHECK(diagnosis::to_prior_units(parameter, value_SI) == Approx(u).margin(1e-9));
    }
  });
}

TEST_CASE("prior units stay within three, and within the range, whatever the value", "[fast]") {
  for_each_parameter([](const EffectParameter& parameter, int sign) {
    for (const double value_SI : {0.0, 1e-12, 1e12}) {
      const double u = diagnosis::to_prior_units(parameter, sign * value_SI);
      CHECK(std::abs(u) <= 3.0);
    }
  });
}

TEST_CASE("the derivative is that of the value", "[fast]") {
  constexpr double kStep = 1e-5;
  for_each_parameter([](const EffectParameter& parameter, int sign) {
    for (const double u : {-1.2, 0.0, 1.5}) {
      const double above = diagnosis::from_prior_units(parameter, u + kStep, sign).value_SI;
      const double below = diagnosis::from_prior_units(parameter, u - kStep, sign).value_SI;
      CHECK(diagnosis::from_prior_units(parameter, u, sign).derivative_SI ==
            Approx((above - below) / (2.0 * kStep)).epsilon(1e-6));
    }
  });
}

TEST_CASE("a size has the sign that is asked for", "[fast]") {
  int both = 0;
  for (const models::Effect* effect : models::all_effects()) {
    const EffectParameter& size = effect->info.parameters.front();
    const std::vector<int> signs = diagnosis::possible_signs(effect->info.parameters.front());
    INFO(effect->info.id);
    CHECK(signs.size() == (size.prior.either_sign ? 2 : 1));
    if (signs.size() < 2) continue;
    ++both;
    for (const double u : {-2.0, 0.0, 2.0}) {
      const double plus = diagnosis::from_prior_units(size, u, 1).value_SI;
      CHECK(diagnosis::from_prior_units(size, u, -1).value_SI == -plus);
    }
  }
  CHECK(both > 0);
}

TEST_CASE("within its bounds a parameter is allowed, beyond them it is not", "[fast]") {
  for_each_parameter([](const EffectParameter& parameter, int sign) {
    const diagnosis::PriorBounds bounds = diagnosis::bounds_in_prior_units(parameter, sign);
    CHECK(bounds.lower < 0.0);
    CHECK(bounds.upper > 0.0);
    const auto allowed = [&](double u) { return diagnosis::from_prior_units(parameter, u, sign).allowed; };
    CHECK(allowed(0.0));
    constexpr double kBeside = 1e-6;
    if (std::isfinite(bounds.lower)) {
      CHECK(allowed(bounds.lower));
      CHECK_FALSE(allowed(bounds.lower - kBeside));
    }
    if (std::isfinite(bounds.upper)) {
      CHECK(allowed(bounds.upper));
      CHECK_FALSE(allowed(bounds.upper + kBeside));
    }
  });
}

TEST_CASE("a start put into prior units lies inside of the bounds", "[fast]") {
  for_each_parameter([](const EffectParameter& parameter, int sign) {
    const diagnosis::PriorBounds bounds = diagnosis::bounds_in_prior_units(parameter, sign);
    for (const double share : {-1.0, 0.0, 0.5, 1.0, 10.0}) {
      const double value_SI = sign * share * parameter.prior.high * unit_of_key(parameter.key).factor;
      const double u = diagnosis::to_prior_units(parameter, value_SI);
      CHECK(u > bounds.lower);
      CHECK(u < bounds.upper);
    }
  });
}

TEST_CASE("terms of a hypothesis stand in one order, however it was put together", "[fast]") {
  const Hypothesis none;
  CHECK(none.name() == "none");
  CHECK(none.names().empty());
  const Hypothesis one = none.with(on("slow_leak")).with(on("bearing_warmup"));
  const Hypothesis other = none.with(on("bearing_warmup")).with(on("slow_leak"));
  CHECK(one.names() == other.names());
  CHECK(one.name() == other.name());
  CHECK(one.names().size() == 2);
  CHECK(one.contains(diagnosis::find_term("slow_leak")));
  CHECK_FALSE(one.contains(diagnosis::find_term("rim_heat")));
  const Hypothesis late = none.with(on("clock_shift", -1)).with(on("rim_heat"));
  for (const SignedTerm& signed_term : late.terms) {
    CHECK(signed_term.sign == (signed_term.term->name() == "clock_shift" ? -1 : 1));
  }
}
