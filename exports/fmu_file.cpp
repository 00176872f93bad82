#include "exports/fmu_file.h"

#include <fmt/format.h>

#include "exports/model_description.h"
#include "exports/xml.h"
#include "exports/zip_archive.h"
#include "fmu/model_block.h"
#include "sim/core/embed.h"
#include "sim/core/error.h"
#include "sim/core/file_io.h"

ROLLRIG_EMBED(rollrig_fmu_library, ROLLRIG_FMU_LIBRARY)
ROLLRIG_EMBED(rollrig_license, "LICENSE")
ROLLRIG_EMBED(rollrig_fmu_third_party, "exports/fmu_third_party.txt")

namespace rollrig::exports {
namespace {

/// Of the content: "{8-4-4-4-12}" hexadecimal digits.
std::string make_token(const std::string& content) {
  const std::string sum = calc_sha256(content);
  return fmt::format("{{{}-{}-{}-{}-{}}}", sum.substr(0, 8), sum.substr(8, 4), sum.substr(12, 4), sum.substr(16, 4),
                     sum.substr(20, 12));
}

/// The shared object with a wheel in its block.
std::string fill_block(std::string library, const std::string& token, const std::string& model) {
  const std::string mark = ROLLRIG_MODEL_BLOCK_MARK;
  const std::size_t at = library.find(mark + '\0');
  if (at == std::string::npos || library.find(mark + '\0', at + 1) != std::string::npos) {
    throw std::logic_error("the shared object of the FMU has no block of its own for a model");
  }
  const std::string content = token + '\n' + model + '\0';
  if (mark.size() + content.size() > fmu::kModelBlockSize) {
    throw InputError({"the tire has too many numbers for an FMU", "", 0, "load_map", "", "a shorter load map", ""});
  }
  return library.replace(at + mark.size(), content.size(), content);
}

constexpr const char* kDocumentation = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>Warm tire</title></head><body>
<h1>Warm tire of rollrig</h1>
<p>One tire on its wheel. Its rolling resistance depends on its temperature, which follows from the heat that rolling
makes, and from what the tire gives to the air and to the surface.</p>
<p>Set speed_m_s, load_N, ambient_temperature_K, surface_temperature_K and drive_force_N. The name of each variable ends
with its unit; ratios have none. Parameters are those of the tire file (resources/tire.toml), and can be set before the
initialization ends. In co-simulation, the speed changes by acceleration_m_s2 through a step, and the other inputs hold
unless they have a slope.</p>
</body></html>
)";

}  // namespace

std::string make_fmu_file(const fmu::WheelModel& model, const NamedFile& tire, const NamedFile& rig, int fmi_version) {
  require_xml_text(tire.name, "the name of the tire", "name", tire.path);
  require_xml_text(rig.name, "the name of the rig", "name", rig.path);
  const std::string text = fmu::write_wheel_model(model);
  const std::string library(rollrig_fmu_library_begin, rollrig_fmu_library_end);
  const std::string tool = fmt::format("rollrig {}", ROLLRIG_VERSION);
  FmuDescription about;
  about.fmi_version = fmi_version;
  about.name = tire.name;
  about.description = fmt::format("Warm tire {} on {}", tire.name, rig.name);
  about.tool = tool;
  about.token = make_token(tool + text + library);
  const std::string folder = fmi_version == 3 ? "binaries/x86_64-linux/" : "binaries/linux64/";
  const fmu::WarmWheel wheel(model);
  return make_zip(
      {{"modelDescription.xml", make_model_description(about, wheel.variables())},
       {folder + kFmuIdentifier + ".so", fill_block(library, about.token, text)},
       {"documentation/index.html", kDocumentation},
       {"documentation/licenses/license.txt", {rollrig_license_begin, rollrig_license_end}},
       {"documentation/licenses/third_party.txt", {rollrig_fmu_third_party_begin, rollrig_fmu_third_party_end}},
       {"resources/tire.toml", read_text_file(tire.path)}});
}

}  // namespace rollrig::exports
