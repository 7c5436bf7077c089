#include "examples/command_line/outputs.h"

#include <filesystem>
#include <set>

#include "platform/file.h"
#include "platform/light_field.h"

namespace starfocus {
namespace {

namespace fs = std::filesystem;

// The same for every way to name a file, there or not.
fs::path NameOf(const fs::path& path) {
  std::error_code ignored;
  const fs::path name = fs::weakly_canonical(fs::absolute(path), ignored);
  return name.has_filename() ? name : name.parent_path();  // "folder/"
}

}  // namespace

std::string CheckApart(const std::vector<Output>& outputs,
                       const std::vector<std::string>& folders) {
  std::set<fs::path> inputs, names;
  for (const std::string& folder : folders) inputs.insert(NameOf(folder));
  for (const Output& output : outputs) {
    const fs::path name = NameOf(output.path);
    if (!names.insert(name).second) {
      return Expected(output.option, "a file of its own", output.path + ", which another one is");
    }
    if (inputs.count(name.parent_path()) != 0 && IsLightFieldFile(name.filename().string())) {
      return Expected(output.option, "a file of its own", output.path + " of the light field");
    }
  }
  return "";
}

}  // namespace starfocus
