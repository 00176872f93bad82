#include <cmath>
#include <iterator>

#include <fmt/format.h>
#include <boost/algorithm/string/replace.hpp>

#include "sim/core/csv.h"

namespace rollrig {

CsvWriter::CsvWriter(const std::vector<std::string>& columns) {
  for (const std::string& column : columns) add(column);
  end_row();
}

void CsvWriter::add(const Rounded& number) {
  const double written = number.value == 0.0 ? 0.0 : number.value;  // no "-0"
  if (!std::isnan(written)) fmt::format_to(std::back_inserter(text_), "{:.{}g}", written, number.digits);
  text_ += ',';
}

void CsvWriter::add(const std::string& text) {
  const bool is_plain = text.find_first_of(",\"\r\n") == std::string::npos;
  text_ += is_plain ? text : '"' + boost::algorithm::replace_all_copy(text, "\"", "\"\"") + '"';
  text_ += ',';
}

}  // namespace rollrig
