#include "estimation/quiet_solver.h"

#include <glog/logging.h>

#include <mutex>

namespace rollrig::estimation {

void quiet_solver() {
  // Once: fits run in several threads, and glog's level belongs to all of them.
  static std::once_flag is_quiet;
  std::call_once(is_quiet, [] { FLAGS_minloglevel = google::GLOG_FATAL; });
}

}  // namespace rollrig::estimation
