#pragma once
/// What Ceres logs by itself.

namespace rollrig::estimation {

/// From now on Ceres logs nothing below a fatal error to standard error: rollrig reports what matters of it. May be
/// called from any thread, any number of times.
void quiet_solver();

}  // namespace rollrig::estimation
