// The baselines on data whose cause is known: one signature, two, none.
#include "validation/scoring/baselines/baselines.h"

#include <catch2/catch.hpp>

#include "sim/core/random.h"
#include "tests/validation/scoring/validation_set_folder.h"
#include "validation/scoring/run_cases.h"

using namespace rollrig;
using namespace rollrig::tests;
using validation::LinearData;
using validation::Naming;

namespace {

constexpr Eigen::Index kBlocks = 400;
constexpr int kEffects = 8;

Eigen::VectorXd draw_noise(std::uint64_t seed, Eigen::Index count = kBlocks) {
  RandomStream random(seed, "baselines");
  Eigen::VectorXd noise(count);
  for (double& value : noise) value = random.normal();
  return noise;
}

/// Noise, and eight effects "a" to "h" whose signatures, of lengths 1 to 8, point anywhere; neighbors overlap.
LinearData make_data(std::uint64_t seed) {
  LinearData data;
  data.residual = draw_noise(seed);
  data.signatures.resize(kBlocks, kEffects);
  Eigen::VectorXd before = Eigen::VectorXd::Zero(kBlocks);
  for (int e = 0; e < kEffects; ++e) {
    const Eigen::VectorXd direction = (draw_noise(100 + static_cast<std::uint64_t>(e)) + 0.5 * before).normalized();
    before = std::sqrt(static_cast<double>(kBlocks)) * direction;
    data.signatures.col(e) = (e + 1.0) * direction;
    data.effects.emplace_back(1, static_cast<char>('a' + e));
  }
  return data;
}

/// With effects of that length of signal.
LinearData make_data(std::uint64_t seed, const std::vector<int>& effects, double length) {
  LinearData data = make_data(seed);
  for (const int e : effects) data.residual += length * data.signatures.col(e).normalized();
  return data;
}

std::vector<const validation::BaselineMethod*> naming_methods() {
  std::vector<const validation::BaselineMethod*> methods;
  for (const validation::BaselineMethod& method : validation::all_baselines()) {
    if (method.name != nullptr) methods.push_back(&method);
  }
  return methods;
}

double sum_of(const Naming& naming) {
  double sum = 0.0;
  for (const auto& [name, probability] : naming.probability) sum += probability;
  return sum;
}

}  // namespace

TEST_CASE("a residual that is one signature is named by each method", "[fast]") {
  REQUIRE(naming_methods().size() == 4);
  for (const validation::BaselineMethod* method : naming_methods()) {
    for (int e = 0; e < kEffects; ++e) {
      INFO(method->id << ", effect " << e);
      const LinearData data = make_data(20, {e}, 30.0);
      const Naming naming = method->name(data);
      REQUIRE_FALSE(naming.chosen.empty());
      CHECK(data.effects[naming.chosen.front()] == data.effects[static_cast<std::size_t>(e)]);
      CHECK(naming.probability.at(data.effects[static_cast<std::size_t>(e)]) > 0.98);
    }
  }
}

TEST_CASE("in noise alone no method but AIC sees a gap", "[fast]") {
  for (const validation::BaselineMethod* method : naming_methods()) {
    int alarms = 0;
    for (std::uint64_t seed = 0; seed < 50; ++seed) {
      const Naming naming = method->name(make_data(seed));
      alarms += naming.chosen.empty() ? 0 : 1;
      if (naming.chosen.empty()) CHECK(naming.named_probability == naming.probability.at("none"));
    }
    INFO(method->id);
    CHECK(alarms <= (std::string(method->id) == "aic" ? 35 : 5));
  }
}

TEST_CASE("forward selection and sparse regression find both of two effects", "[fast]") {
  for (const validation::BaselineMethod* method : naming_methods()) {
    if (std::string(method->id) == "nearest") continue;
    INFO(method->id);
    const LinearData data = make_data(3, {2, 6}, 20.0);
    const std::vector<std::string> named = validation::find_named(data, method->name(data).chosen);
    CHECK(std::count(named.begin(), named.end(), "c") == 1);
    CHECK(std::count(named.begin(), named.end(), "g") == 1);
    CHECK(named.size() <= 3);
  }
}

TEST_CASE("an effect whose sign is given is not named for the other sign", "[fast]") {
  for (const validation::BaselineMethod* method : naming_methods()) {
    INFO(method->id);
    const LinearData data = make_data(4, {1}, -30.0);
    for (const std::size_t column : method->name(data).chosen) CHECK(data.effects[column] != "b");
  }
}

TEST_CASE("of either sign an effect has two signatures, and is named once", "[fast]") {
  LinearData data = make_data(5, {3}, -30.0);
  data.signatures.conservativeResize(Eigen::NoChange, kEffects + 1);
  data.signatures.col(kEffects) = -data.signatures.col(3);
  data.effects.emplace_back("d");
  for (const validation::BaselineMethod* method : naming_methods()) {
    INFO(method->id);
    const Naming naming = method->name(data);
    const std::vector<std::string> named = validation::find_named(data, naming.chosen);
    REQUIRE_FALSE(named.empty());
    CHECK(named.front() == "d");
    CHECK(std::count(named.begin(), named.end(), "d") == 1);
    CHECK(naming.probability.at("d") <= 1.0 + 1e-12);
  }
}

TEST_CASE("probabilities of one effect at a time add to 1", "[fast]") {
  CHECK(sum_of(validation::name_by_nearest_signature(make_data(1, {1}, 25.0))) == Approx(1.0));
  CHECK(sum_of(validation::name_by_nearest_signature(make_data(1))) == Approx(1.0));
}

TEST_CASE("what each explains shares the probability as exp(chi2/2)", "[fast]") {
  LinearData data;
  data.effects = {"a", "b"};
  data.signatures = Eigen::MatrixXd::Identity(2, 2);
  data.residual = Eigen::Vector2d(6.0, 5.0);
  const Naming naming = validation::name_by_nearest_signature(data);
  CHECK(naming.probability.at("a") == Approx(0.99 / (1.0 + std::exp(0.5 * (25.0 - 36.0)))));
  CHECK(naming.probability.at("none") == 0.01);
  CHECK(naming.named_probability == naming.probability.at("a"));
}

TEST_CASE("weights of Akaike are those counted by hand", "[fast]") {
  LinearData data;
  data.effects = {"a", "b"};
  data.signatures = Eigen::MatrixXd::Identity(2, 2);
  data.residual = Eigen::Vector2d(3.0, 1.0);  // criteria: none 10, a 3, b 11, both 4
  const Naming naming = validation::name_by_aic(data);
  CHECK(naming.chosen == std::vector<std::size_t>{0});
  const double sum = std::exp(-3.5) + 1.0 + std::exp(-4.0) + std::exp(-0.5);
  CHECK(naming.probability.at("none") == Approx(std::exp(-3.5) / sum));
  CHECK(naming.probability.at("a") == Approx((1.0 + std::exp(-0.5)) / sum));
  CHECK(naming.named_probability == naming.probability.at("a"));
}

TEST_CASE("without any signature there is no gap to name", "[fast]") {
  LinearData data = make_data(1, {1}, 30.0);
  data.effects.clear();
  data.signatures.resize(kBlocks, 0);
  for (const validation::BaselineMethod* method : naming_methods()) {
    INFO(method->id);
    CHECK(method->name(data).chosen.empty());
  }
}

TEST_CASE("the projection is the inverse root of noise and priors together", "[fast]") {
  diagnosis::RowMatrix jacobian(30, 3);
  for (int c = 0; c < 3; ++c) jacobian.col(c) = (c + 1.0) * draw_noise(static_cast<std::uint64_t>(c), 30);
  const Eigen::MatrixXd root = validation::BaseProjection(jacobian).apply(Eigen::MatrixXd::Identity(30, 30));
  const Eigen::MatrixXd covariance = Eigen::MatrixXd::Identity(30, 30) + jacobian * jacobian.transpose();
  CHECK((root * covariance * root - Eigen::MatrixXd::Identity(30, 30)).norm() < 1e-9);
}

TEST_CASE("least squares of twins shares the amplitude, of strangers gives each its own", "[fast]") {
  LinearData data;
  data.effects = {"a", "b", "c"};
  data.signatures = Eigen::MatrixXd::Zero(3, 3);
  data.signatures(0, 0) = data.signatures(0, 1) = 2.0;
  data.signatures(1, 2) = 4.0;
  data.residual = Eigen::Vector3d(8.0, 2.0, 1.0);
  const validation::LeastSquares squares(data);
  const auto twins = squares.fit({0, 1});
  CHECK(twins.amplitudes[0] == Approx(2.0));
  CHECK(twins.amplitudes[1] == Approx(2.0));
  const auto strangers = squares.fit({2, 0});
  CHECK(strangers.amplitudes[0] == Approx(0.5));
  CHECK(strangers.sd[0] == Approx(0.25));
  CHECK(strangers.chi2 == Approx(1.0));
}

TEST_CASE("a baseline's folder is scored where it is there, and the process by its shrinkage alone", "[fast]") {
  const ValidationSetFolder made;
  validation::ScoreOrder order;
  order.set = made.root;
  CHECK(validation::score_baselines(order, {}).empty());
  const auto tasks = validation::plan_tasks(made.root, {}, {});
  for (const validation::BaselineMethod& method : validation::all_baselines()) {
    if (std::string(method.id) != "bic" && method.name != nullptr) continue;
    validation::RunOrder run{made.root, validation::baseline_folder(made.root, method), tasks};
    run.answer_by = [&method](const auto& set, const auto& settings) {
      return validation::diagnose_by(method, set, settings);
    };
    CHECK(validation::run_cases(run).failures.size() == 3);  // the sets are no sets
  }
  const auto scores = validation::score_baselines(order, {});
  REQUIRE(scores.size() == 2);
  CHECK(scores[0].id == "bic");
  CHECK(scores[0].values.at("detection") == 0.0);
  CHECK(scores[1].id == "gp");
  CHECK(scores[1].values.empty());
  std::filesystem::remove(made.root + "/answers-bic/0002.json");
  CHECK_THROWS_WITH(validation::score_baselines(order, {}),
                    Catch::Contains("rollrig_validation baselines " + made.root));
  order.truth_was_left_out = true;
  CHECK(validation::score_baselines(order, {}).empty());
}
