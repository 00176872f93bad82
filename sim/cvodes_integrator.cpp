#include "sim/cvodes_integrator.h"

#include <cvodes/cvodes.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <algorithm>
#include <cmath>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "sim/core/error.h"
#include "sim/difference_jacobian.h"

namespace rollrig::sim {
namespace {

struct ContextDeleter {
  void operator()(SUNContext context) const { SUNContext_Free(&context); }
};
struct VectorDeleter {
  void operator()(N_Vector v) const { N_VDestroy(v); }
};
struct MatrixDeleter {
  void operator()(SUNMatrix m) const { SUNMatDestroy(m); }
};
struct SolverDeleter {
  void operator()(SUNLinearSolver s) const { SUNLinSolFree(s); }
};
struct MemoryDeleter {
  void operator()(void* memory) const { CVodeFree(&memory); }
};

using ContextPtr = std::unique_ptr<std::remove_pointer_t<SUNContext>, ContextDeleter>;
using VectorPtr = std::unique_ptr<std::remove_pointer_t<N_Vector>, VectorDeleter>;
using MatrixPtr = std::unique_ptr<std::remove_pointer_t<SUNMatrix>, MatrixDeleter>;
using SolverPtr = std::unique_ptr<std::remove_pointer_t<SUNLinearSolver>, SolverDeleter>;
using MemoryPtr = std::unique_ptr<void, MemoryDeleter>;

ContextPtr make_context() {
  SUNContext context = nullptr;
  if (SUNContext_Create(nullptr, &context) != 0) throw RunFailure("CVODES: no context");
  return ContextPtr(context);
}

VectorPtr make_vector(std::size_t size, SUNContext context) {
  return VectorPtr(N_VNew_Serial(static_cast<sunindextype>(std::max<std::size_t>(size, 1)), context));
}

void require_success(int flag, const char* call) {
  if (flag < 0) throw RunFailure(std::string("CVODES: ") + call + " returned " + std::to_string(flag));
}

bool all_finite(const double* values, std::size_t count) {
  return std::all_of(values, values + count, [](double v) { return std::isfinite(v); });
}

}  // namespace

class CvodesIntegrator::Implementation {
 public:
  Implementation(OdeSystem<double>& system, const CvodesOptions& options)
      : system_(system),
        n_(system.state_count()),
        m_(system.integrals().size()),
        differences_(system.state_tolerances()),
        integrands_(m_),
        context_(make_context()),
        y_(make_vector(n_, context_.get())),
        q_(make_vector(m_, context_.get())),
        tolerance_(make_vector(n_, context_.get())),
        q_tolerance_(make_vector(m_, context_.get())),
        scratch_(make_vector(n_, context_.get())),
        q_scratch_(make_vector(m_, context_.get())),
        memory_(CVodeCreate(CV_BDF, context_.get())) {
    set_up(options);
  }

  void begin_run(double time_s) {
    time_s_ = time_s;
    restarted_at_s_.reset();
    N_VConst(0.0, y_.get());
    N_VConst(0.0, q_.get());
  }

  void begin_segment(const StopCondition* stop) {
    collect_statistics();
    stop_ = stop;
    integrands_s_ = kNever_s;
    require_success(CVodeReInit(memory(), time_s_, y_.get()), "CVodeReInit");
    counted_ = {};  // CVODES counts from zero again
    if (m_ > 0) require_success(CVodeQuadReInit(memory(), q_.get()), "CVodeQuadReInit");
    require_success(CVodeRootInit(memory(), stop_ != nullptr ? 1 : 0, stop_ != nullptr ? calc_root : nullptr),
                    "CVodeRootInit");
  }

  bool step(double end_time_s) {
    if (stop_ != nullptr && distance_to_stop(time_s_, data(y_)) <= 0.0) return true;
    require_success(CVodeSetStopTime(memory(), end_time_s), "CVodeSetStopTime");
    int flag = CVode(memory(), end_time_s, y_.get(), &time_s_, CV_ONE_STEP);
    if (flag == CV_ERR_FAILURE && pending_ == nullptr && restarted_at_s_ != time_s_) {
      // A jump of the rates, as when a bouncing wheel lifts off, spoils the history of the steps: once more
      // from the last good state, with none.
      restarted_at_s_ = time_s_;
      restart();
      flag = CVode(memory(), end_time_s, y_.get(), &time_s_, CV_ONE_STEP);
    }
    if (pending_ != nullptr) std::rethrow_exception(std::exchange(pending_, nullptr));
    if (flag < 0) {
      throw RunFailure("integration failed at t = " + std::to_string(time_s_) + " s: " + message_ +
                       "; the last good state is that of this time");
    }
    if (flag == CV_TSTOP_RETURN) time_s_ = end_time_s;
    if (m_ > 0) {
      double at_s = 0.0;
      require_success(CVodeGetQuad(memory(), &at_s, q_.get()), "CVodeGetQuad");
    }
    return flag == CV_ROOT_RETURN;
  }

  void interpolate_state(double time_s, double* out) {
    require_success(CVodeGetDky(memory(), time_s, 0, scratch_.get()), "CVodeGetDky");
    std::copy(data(scratch_), data(scratch_) + n_, out);
  }

  void interpolate_integrals(double time_s, double* out) {
    if (m_ == 0) return;
    require_success(CVodeGetQuadDky(memory(), time_s, 0, q_scratch_.get()), "CVodeGetQuadDky");
    std::copy(data(q_scratch_), data(q_scratch_) + m_, out);
  }

  double time_s() const { return time_s_; }
  double* state() { return data(y_); }
  double* integrals() { return data(q_); }

  IntegratorStatistics statistics() {
    collect_statistics();
    return statistics_;
  }

 private:
  void set_up(const CvodesOptions& options) {
    require_success(CVodeSetErrHandlerFn(memory(), note_error, this), "CVodeSetErrHandlerFn");
    require_success(CVodeInit(memory(), calc_rates, 0.0, y_.get()), "CVodeInit");
    require_success(CVodeSetUserData(memory(), this), "CVodeSetUserData");
    const double relative = options.relative_tolerance * options.tolerance_factor;
    set_tolerances(options.tolerance_factor, relative);
    require_success(CVodeSetMaxOrd(memory(), options.max_order), "CVodeSetMaxOrd");
    require_success(CVodeSetMaxNumSteps(memory(), -1), "CVodeSetMaxNumSteps");
    matrix_.reset(SUNDenseMatrix(static_cast<sunindextype>(n_), static_cast<sunindextype>(n_), context_.get()));
    solver_.reset(SUNLinSol_Dense(y_.get(), matrix_.get(), context_.get()));
    require_success(CVodeSetLinearSolver(memory(), solver_.get(), matrix_.get()), "CVodeSetLinearSolver");
    require_success(CVodeSetJacFn(memory(), calc_jacobian), "CVodeSetJacFn");
  }

  void set_tolerances(double factor, double relative) {
    const std::vector<double> state_tolerances = system_.state_tolerances();
    for (std::size_t i = 0; i < n_; ++i) data(tolerance_)[i] = factor * state_tolerances[i];
    require_success(CVodeSVtolerances(memory(), relative, tolerance_.get()), "CVodeSVtolerances");
    if (m_ == 0) return;
    for (std::size_t i = 0; i < m_; ++i) data(q_tolerance_)[i] = factor * system_.integrals()[i].tolerance_SI;
    require_success(CVodeQuadInit(memory(), calc_integrands, q_.get()), "CVodeQuadInit");
    require_success(CVodeQuadSVtolerances(memory(), 0.0, q_tolerance_.get()), "CVodeQuadSVtolerances");
    require_success(CVodeSetQuadErrCon(memory(), SUNTRUE), "CVodeSetQuadErrCon");
  }

  template <class F>
  int guarded(F&& call) {
    try {
      return call();
    } catch (...) {
      pending_ = std::current_exception();
      return -1;
    }
  }

  static Implementation& self(void* user_data) { return *static_cast<Implementation*>(user_data); }
  static double* data(const VectorPtr& v) { return N_VGetArrayPointer(v.get()); }

  static int calc_rates(realtype t, N_Vector y, N_Vector rates, void* user_data) {
    Implementation& me = self(user_data);
    return me.guarded([&] {
      me.integrands_s_ = kNever_s;
      me.system_.evaluate(t, N_VGetArrayPointer(y), N_VGetArrayPointer(rates), me.integrands_.data());
      me.integrands_s_ = t;
      return all_finite(N_VGetArrayPointer(rates), me.n_) ? 0 : 1;
    });
  }

  static int calc_jacobian(realtype t, N_Vector y, N_Vector rates, SUNMatrix jacobian, void* user_data, N_Vector,
                           N_Vector, N_Vector) {
    Implementation& me = self(user_data);
    return me.guarded([&] {
      me.differences_.fill(N_VGetArrayPointer(y), N_VGetArrayPointer(rates), SUNDenseMatrix_Data(jacobian),
                           [&](const double* changed, double* out) {
                             me.system_.evaluate(t, changed, out, nullptr);
                             ++me.statistics_.rate_evaluations;
                           });
      return all_finite(SUNDenseMatrix_Data(jacobian), me.n_ * me.n_) ? 0 : 1;
    });
  }

  /// Integrands at the end of a step: those of the last evaluation of the rates, one Newton correction before the
  /// solution. That correction is at most as large as the error that a step may have. To find the bodies' motion once
  /// more at the solution would take two fifths of the time.
  static int calc_integrands(realtype t, N_Vector y, N_Vector integrands, void* user_data) {
    Implementation& me = self(user_data);
    return me.guarded([&] {
      double* out = N_VGetArrayPointer(integrands);
      if (t == me.integrands_s_) {
        std::copy(me.integrands_.begin(), me.integrands_.end(), out);
      } else {
        me.system_.evaluate(t, N_VGetArrayPointer(y), nullptr, out);
      }
      return all_finite(out, me.m_) ? 0 : 1;
    });
  }

  static int calc_root(realtype t, N_Vector y, realtype* distance, void* user_data) {
    Implementation& me = self(user_data);
    return me.guarded([&] {
      *distance = me.distance_to_stop(t, N_VGetArrayPointer(y));
      return 0;
    });
  }

  static void note_error(int, const char*, const char*, char* message, void* user_data) {
    self(user_data).message_ = message;
  }

  double distance_to_stop(double time_s, const double* state) {
    return stop_->find_distance(system_.watch(stop_->watch, time_s, state));
  }

  void restart() {
    double at_s = 0.0;
    if (m_ > 0) require_success(CVodeGetQuad(memory(), &at_s, q_.get()), "CVodeGetQuad");
    begin_segment(stop_);
  }

  void collect_statistics() {
    IntegratorStatistics now;
    CVodeGetNumSteps(memory(), &now.steps);
    CVodeGetNumRhsEvals(memory(), &now.rate_evaluations);
    CVodeGetNumJacEvals(memory(), &now.jacobian_evaluations);
    CVodeGetNumErrTestFails(memory(), &now.error_test_failures);
    statistics_.steps += now.steps - counted_.steps;
    statistics_.rate_evaluations += now.rate_evaluations - counted_.rate_evaluations;
    statistics_.jacobian_evaluations += now.jacobian_evaluations - counted_.jacobian_evaluations;
    statistics_.error_test_failures += now.error_test_failures - counted_.error_test_failures;
    counted_ = now;
  }

  void* memory() const { return memory_.get(); }

  OdeSystem<double>& system_;
  std::size_t n_;
  std::size_t m_;
  DifferenceJacobian differences_;
  static constexpr double kNever_s = -1e300;
  std::vector<double> integrands_;  // at integrands_s_, of the last evaluation of rates in the segment
  double integrands_s_ = kNever_s;
  ContextPtr context_;
  VectorPtr y_, q_, tolerance_, q_tolerance_, scratch_, q_scratch_;
  MatrixPtr matrix_;
  SolverPtr solver_;
  MemoryPtr memory_;
  const StopCondition* stop_ = nullptr;
  double time_s_ = 0.0;
  std::optional<double> restarted_at_s_;
  std::exception_ptr pending_;
  std::string message_;
  IntegratorStatistics statistics_;
  IntegratorStatistics counted_;
};

CvodesIntegrator::CvodesIntegrator(OdeSystem<double>& system, const CvodesOptions& options)
    : implementation_(std::make_unique<Implementation>(system, options)) {}
CvodesIntegrator::~CvodesIntegrator() = default;

void CvodesIntegrator::begin_run(double time_s) { implementation_->begin_run(time_s); }
void CvodesIntegrator::begin_segment(double, const StopCondition* stop) { implementation_->begin_segment(stop); }
bool CvodesIntegrator::step(double end_time_s) { return implementation_->step(end_time_s); }
double CvodesIntegrator::time_s() const { return implementation_->time_s(); }
double* CvodesIntegrator::state() { return implementation_->state(); }
double* CvodesIntegrator::integrals() { return implementation_->integrals(); }
void CvodesIntegrator::interpolate_state(double time_s, double* state) {
  implementation_->interpolate_state(time_s, state);
}
void CvodesIntegrator::interpolate_integrals(double time_s, double* integrals) {
  implementation_->interpolate_integrals(time_s, integrals);
}
IntegratorStatistics CvodesIntegrator::statistics() const { return implementation_->statistics(); }

}  // namespace rollrig::sim
