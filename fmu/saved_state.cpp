#include "fmu/saved_state.h"

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "sim/core/error.h"

namespace rollrig::fmu {
namespace {

struct Head {
  char mark[8] = {'R', 'R', 'W', 'H', 'E', 'E', 'L', '2'};
  std::uint64_t checksum = 0;  // of all behind it
  std::uint64_t wheel = 0;
  std::uint64_t stage = 0;
  std::uint64_t counts[4] = {};  // parameters, inputs, slopes, states
  double time_s = 0.0;
  double start_s = 0.0;
  double stop_s = 0.0;
};

constexpr std::size_t kChecked = offsetof(Head, wheel);  // from here on, the checksum covers the bytes

/// Calls visit(list) for each list of numbers.
template <class Wheel, class Visit>
void visit_lists(Wheel& wheel, Visit&& visit) {
  visit(wheel.parameters);
  visit(wheel.inputs);
  visit(wheel.input_slopes);
  visit(wheel.states);
}

InputError not_a_state() {
  return InputError({"these bytes are not a state of this wheel", "", 0, "", "", "bytes that were serialized", ""});
}

}  // namespace

std::size_t count_bytes(const SavedState& state) {
  std::size_t numbers = 0;
  visit_lists(state.wheel, [&numbers](const std::vector<double>& list) { numbers += list.size(); });
  return sizeof(Head) + numbers * sizeof(double);
}

std::vector<char> serialize(const SavedState& state) {
  Head head;
  head.stage = static_cast<std::uint64_t>(state.stage);
  head.time_s = state.wheel.time_s;
  head.start_s = state.start_s;
  head.stop_s = state.stop_s;
  std::vector<char> bytes(count_bytes(state));
  char* end = bytes.data() + sizeof(Head);
  std::uint64_t* count = head.counts;
  visit_lists(state.wheel, [&](const std::vector<double>& list) {
    *count++ = list.size();
    if (!list.empty()) std::memcpy(end, list.data(), list.size() * sizeof(double));
    end += list.size() * sizeof(double);
  });
  head.wheel = state.wheel.wheel;
  std::memcpy(bytes.data(), &head, sizeof(Head));
  head.checksum = calc_checksum(bytes.data() + kChecked, bytes.size() - kChecked);
  std::memcpy(bytes.data(), &head, sizeof(Head));
  return bytes;
}

SavedState deserialize(const char* bytes, std::size_t size) {
  const Head wanted;
  Head head;
  if (bytes == nullptr || size < sizeof(Head)) throw not_a_state();
  std::memcpy(&head, bytes, sizeof(Head));
  if (std::memcmp(head.mark, wanted.mark, sizeof(head.mark)) != 0) throw not_a_state();
  std::size_t left = (size - sizeof(Head)) / sizeof(double);
  for (const std::uint64_t count : head.counts) {
    if (count > left) throw not_a_state();
    left -= static_cast<std::size_t>(count);
  }
  if (left != 0 || (size - sizeof(Head)) % sizeof(double) != 0 || head.stage > 100 ||
      head.checksum != calc_checksum(bytes + kChecked, size - kChecked)) {
    throw not_a_state();
  }
  SavedState state;
  state.stage = static_cast<int>(head.stage);
  state.start_s = head.start_s;
  state.stop_s = head.stop_s;
  state.wheel.time_s = head.time_s;
  state.wheel.wheel = head.wheel;
  const char* from = bytes + sizeof(Head);
  const std::uint64_t* count = head.counts;
  visit_lists(state.wheel, [&](std::vector<double>& list) {
    list.resize(static_cast<std::size_t>(*count++));
    if (!list.empty()) std::memcpy(list.data(), from, list.size() * sizeof(double));
    from += list.size() * sizeof(double);
  });
  return state;
}

}  // namespace rollrig::fmu
