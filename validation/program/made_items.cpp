#include "validation/program/made_items.h"

#include <utility>

#include "campaigns/items.h"
#include "sim/core/error.h"
#include "validation/scoring/answer.h"

namespace rollrig::validation {
namespace {

class MadeItems : public campaigns::ItemList {
 public:
  MadeItems(std::size_t count, const std::function<Json(std::size_t)>& make) : count_(count), make_(make) {}

  std::size_t count() const override { return count_; }
  Json describe(std::size_t item) const override { return {{"item", item}}; }
  Json carry_out(std::size_t item, std::uint64_t) const override { return make_(item); }
  /// The order says the seed of all; each item draws from streams of its own.
  std::uint64_t calc_seed(std::size_t, std::uint64_t) const override { return 0; }

 private:
  std::size_t count_;
  const std::function<Json(std::size_t)>& make_;
};

}  // namespace

generator::MakeItems make_by_campaign(int threads, cli::ProgressLine& line, std::string what) {
  return [threads, &line, what = std::move(what)](std::size_t count, const std::function<Json(std::size_t)>& make,
                                                  const std::function<void(const Json&)>& take) {
    const MadeItems items(count, make);
    const campaigns::CampaignFolder nowhere{"", hash_program(), 0};  // the results go into no file of a campaign
    const auto visit = [&take](const campaigns::Record& record) {
      if (!record.failure.empty()) throw RunFailure(record.failure);
      take(Json::parse(record.result));
    };
    campaigns::carry_out_all(items, nowhere, threads, visit,
                             [&](double share_done) { line.update(share_done, what); });
  };
}

}  // namespace rollrig::validation
