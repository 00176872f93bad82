#pragma once
/// Dimensions, and a scalar that carries one, so that a machine checks the units of every equation.

#include <cmath>
#include <stdexcept>
#include <string>

namespace rollrig {

/// Exponents of the base units kilogram, meter, second and kelvin. Radians count as dimensionless.
struct Dimension {
  int kg = 0;
  int m = 0;
  int s = 0;
  int K = 0;

  constexpr bool operator==(const Dimension& other) const {
    return kg == other.kg && m == other.m && s == other.s && K == other.K;
  }
  constexpr bool operator!=(const Dimension& other) const { return !(*this == other); }
  constexpr Dimension operator*(const Dimension& other) const {
    return {kg + other.kg, m + other.m, s + other.s, K + other.K};
  }
  constexpr Dimension operator/(const Dimension& other) const {
    return {kg - other.kg, m - other.m, s - other.s, K - other.K};
  }
  constexpr bool is_dimensionless() const { return *this == Dimension{}; }

  /// For messages, such as "kg m s^-2"; "1" when dimensionless.
  std::string to_string() const;
};

/// Names for the dimensions that constants in equations need.
namespace dimension {
constexpr Dimension kNone{};
constexpr Dimension kMass{1, 0, 0, 0};
constexpr Dimension kLength{0, 1, 0, 0};
constexpr Dimension kTime{0, 0, 1, 0};
constexpr Dimension kTemperature{0, 0, 0, 1};
constexpr Dimension kSpeed{0, 1, -1, 0};
constexpr Dimension kAcceleration{0, 1, -2, 0};
constexpr Dimension kForce{1, 1, -2, 0};
constexpr Dimension kPower{1, 2, -3, 0};
constexpr Dimension kPressure{1, -1, -2, 0};
}  // namespace dimension

/// Thrown when an equation adds, compares or exponentiates what its dimensions forbid.
class DimensionError : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

/// A number with its dimension. Default-constructed it is a zero that fits any dimension, so that a sum
/// can start from it. Used by tests in the place of double; slow, and never part of a simulation.
class DimensionedScalar {
 public:
  DimensionedScalar() = default;
  DimensionedScalar(double value) : value_(value), adapts_(false) {}  // NOLINT(google-explicit-constructor)
  DimensionedScalar(double value, Dimension dimension) : value_(value), dimension_(dimension), adapts_(false) {}

  double value() const { return value_; }
  Dimension dimension() const { return dimension_; }

  DimensionedScalar& operator+=(const DimensionedScalar& other);
  DimensionedScalar& operator-=(const DimensionedScalar& other);
  DimensionedScalar& operator*=(const DimensionedScalar& other);
  DimensionedScalar& operator/=(const DimensionedScalar& other);
  DimensionedScalar operator-() const;

  /// Throws DimensionError unless both can stand on two sides of a sum or a comparison.
  static void require_same(const DimensionedScalar& a, const DimensionedScalar& b, const char* operation);

 private:
  double value_ = 0.0;
  Dimension dimension_;
  bool adapts_ = true;  // a zero of any dimension

  friend DimensionedScalar sqrt(const DimensionedScalar& x);
};

inline DimensionedScalar operator+(DimensionedScalar a, const DimensionedScalar& b) { return a += b; }
inline DimensionedScalar operator-(DimensionedScalar a, const DimensionedScalar& b) { return a -= b; }
inline DimensionedScalar operator*(DimensionedScalar a, const DimensionedScalar& b) { return a *= b; }
inline DimensionedScalar operator/(DimensionedScalar a, const DimensionedScalar& b) { return a /= b; }

bool operator<(const DimensionedScalar& a, const DimensionedScalar& b);
inline bool operator>(const DimensionedScalar& a, const DimensionedScalar& b) { return b < a; }
inline bool operator<=(const DimensionedScalar& a, const DimensionedScalar& b) { return !(b < a); }
inline bool operator>=(const DimensionedScalar& a, const DimensionedScalar& b) { return !(a < b); }

DimensionedScalar exp(const DimensionedScalar& x);
DimensionedScalar log(const DimensionedScalar& x);
DimensionedScalar sin(const DimensionedScalar& x);
DimensionedScalar tanh(const DimensionedScalar& x);
DimensionedScalar pow(const DimensionedScalar& base, const DimensionedScalar& exponent);
DimensionedScalar sqrt(const DimensionedScalar& x);
DimensionedScalar abs(const DimensionedScalar& x);

}  // namespace rollrig
