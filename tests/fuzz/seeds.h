#pragma once
/// Inputs that the fuzzers begin with: files of the tree, as they are and put together, and texts.

#include <filesystem>
#include <string>
#include <vector>

namespace rollrig::fuzz {

using Seeds = std::vector<std::string>;

/// Where the tree is.
const std::filesystem::path& source_folder();
/// Up to the end of a line, a few dozen of them: short inputs are quick to read.
std::string first_lines(const std::string& text);

/// Files of the tree below a folder whose names begin and end so, in the order of their paths; of a CSV the first
/// lines.
struct SeedPlace {
  std::string folder, begin, ending;
};
Seeds read_seeds(const std::vector<SeedPlace>& places);

/// Files of a measurement set, in the order of its parts.
const std::vector<std::string>& files_of_set();
Seeds bundle_sets();
/// A mapping, a tire, and the two logs.
Seeds bundle_imports();
/// result.json, recording.csv, manifest.json.
Seeds bundle_results();
/// The same of a run with a budget and an energy audit, to be compared with itself.
Seeds bundle_compared_results();
/// The file of the coastdowns of a drum, and a table.
Seeds bundle_drum_coasts();
/// Coastdowns as a run records them, and its manifest.
Seeds bundle_recorded_coasts();
/// Measurements of alignment tires, and values of the reference laboratory.
Seeds bundle_reference_values();
/// Alignments that align_machine() made, and wrong ones.
Seeds make_alignments();
/// Definitions of campaigns of runs and of diagnoses.
Seeds make_campaigns();
/// Files of results of a campaign with the definition kCampaign.
constexpr const char* kCampaign = "campaign";
Seeds make_campaign_results();
/// Sizes of tires, units, dates, axes of a sweep.
Seeds make_words();

}  // namespace rollrig::fuzz
