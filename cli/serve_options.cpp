#include "cli/serve_options.h"

#include "cli/output_files.h"

namespace rollrig::cli {

void add_serve_options(CLI::App& command, ServeOptions& options) {
  constexpr int kMostPort = 65535;
  const auto add_files = [&command](const char* option, std::vector<std::string>& files, const char* doc) {
    command.add_option(option, files, doc)->expected(1)->take_all()->type_name("FILE");
  };
  command.add_option("--port", options.port, "Port on this computer [any that is free]")->check(in_range(1, kMostPort));
  add_output_option(command, "--keep", options.keep_folder, "Folder for pages that are kept [rollrig_serve]");
  add_files("--tire", options.tires, "A tire file to choose beside the assets; may be repeated");
  add_files("--rig", options.rigs, "Likewise a rig file");
  add_files("--vehicle", options.vehicles, "Likewise a vehicle file");
  add_threads(command, options.threads, "Threads of a diagnosis; 0 for all but one of the machine [0]");
}

}  // namespace rollrig::cli
