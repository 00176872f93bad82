#include "scenarios/run/run_spec.h"
#include "sim/core/csv.h"

namespace rollrig::scenarios {

std::string make_recording_csv(const sim::Recording<double>& recording) {
  std::vector<std::string> columns{"time_s", "phase"};
  std::vector<Unit> units;
  for (const sim::Channel& channel : recording.channels) {
    columns.push_back(channel.quantity.header());
    units.push_back(channel.quantity.file_unit());
  }
  CsvWriter csv(columns);
  for (std::size_t row = 0; row < recording.row_count(); ++row) {
    csv.add(recording.time_s[row]);
    csv.add(recording.phases[recording.phase[row]].name);
    for (std::size_t i = 0; i < units.size(); ++i) csv.add(units[i].from_si(recording.values[i][row]));
    csv.end_row();
  }
  return csv.take();
}

}  // namespace rollrig::scenarios
