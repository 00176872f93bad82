#include "sim/core/dimension.h"

#include <fmt/format.h>

namespace rollrig {
namespace {

void require_dimensionless(const DimensionedScalar& x, const char* operation) {
  if (!x.dimension().is_dimensionless()) {
    throw DimensionError(fmt::format("{} of a quantity in {}", operation, x.dimension().to_string()));
  }
}

}  // namespace

std::string Dimension::to_string() const {
  std::string text;
  const auto append = [&text](const char* symbol, int exponent) {
    if (exponent == 0) return;
    if (!text.empty()) text += ' ';
    text += exponent == 1 ? symbol : fmt::format("{}^{}", symbol, exponent);
  };
  append("kg", kg);
  append("m", m);
  append("s", s);
  append("K", K);
  return text.empty() ? "1" : text;
}

void DimensionedScalar::require_same(const DimensionedScalar& a, const DimensionedScalar& b, const char* operation) {
  if (a.adapts_ || b.adapts_ || a.dimension_ == b.dimension_) return;
  throw DimensionError(fmt::format("{} of {} and {}", operation, a.dimension_.to_string(), b.dimension_.to_string()));
}

DimensionedScalar& DimensionedScalar::operator+=(const DimensionedScalar& other) {
  require_same(*this, other, "sum");
  if (adapts_) {
    dimension_ = other.dimension_;
    adapts_ = other.adapts_;
  }
  value_ += other.value_;
  return *this;
}

DimensionedScalar& DimensionedScalar::operator-=(const DimensionedScalar& other) { return *this += -other; }

DimensionedScalar& DimensionedScalar::operator*=(const DimensionedScalar& other) {
  value_ *= other.value_;
  dimension_ = dimension_ * other.dimension_;
  adapts_ = adapts_ || other.adapts_;
  return *this;
}

DimensionedScalar& DimensionedScalar::operator/=(const DimensionedScalar& other) {
  value_ /= other.value_;
  dimension_ = dimension_ / other.dimension_;
  return *this;
}

DimensionedScalar DimensionedScalar::operator-() const {
  DimensionedScalar result = *this;
  result.value_ = -value_;
  return result;
}

bool operator<(const DimensionedScalar& a, const DimensionedScalar& b) {
  DimensionedScalar::require_same(a, b, "comparison");
  return a.value() < b.value();
}

DimensionedScalar exp(const DimensionedScalar& x) {
  require_dimensionless(x, "exp");
  return {std::exp(x.value())};
}

DimensionedScalar log(const DimensionedScalar& x) {
  require_dimensionless(x, "log");
  return {std::log(x.value())};
}

DimensionedScalar sin(const DimensionedScalar& x) {
  require_dimensionless(x, "sin");
  return {std::sin(x.value())};
}

DimensionedScalar tanh(const DimensionedScalar& x) {
  require_dimensionless(x, "tanh");
  return {std::tanh(x.value())};
}

DimensionedScalar pow(const DimensionedScalar& base, const DimensionedScalar& exponent) {
  require_dimensionless(base, "pow");
  require_dimensionless(exponent, "pow");
  return {std::pow(base.value(), exponent.value())};
}

DimensionedScalar sqrt(const DimensionedScalar& x) {
  const Dimension d = x.dimension();
  if (d.kg % 2 != 0 || d.m % 2 != 0 || d.s % 2 != 0 || d.K % 2 != 0) {
    throw DimensionError(fmt::format("sqrt of a quantity in {}", d.to_string()));
  }
  DimensionedScalar result = x;
  result.value_ = std::sqrt(x.value_);
  result.dimension_ = {d.kg / 2, d.m / 2, d.s / 2, d.K / 2};
  return result;
}

DimensionedScalar abs(const DimensionedScalar& x) { return x.value() < 0.0 ? -x : x; }

}  // namespace rollrig
