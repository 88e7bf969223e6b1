#include "app/commands/private_folder.h"

#include <cstdlib>
#include <filesystem>
#include <system_error>

#include "app/text/usage_error.h"

namespace app {
namespace {

/// mkdtemp puts letters in their place.
constexpr char kLetters[] = "XXXXXX";

}  // namespace

PrivateFolder::PrivateFolder(const std::string& beginning, const std::string& name)
    : path_(std::filesystem::absolute(beginning).string() + kLetters) {
  if (::mkdtemp(path_.data()) == nullptr)
    throw UsageError(name + ": no folder can be made beside " + beginning + "; free some space, or name another place");
}

PrivateFolder::~PrivateFolder() {
  std::error_code failed;
  std::filesystem::remove_all(path_, failed);
}

}  // namespace app
