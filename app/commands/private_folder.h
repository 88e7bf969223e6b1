// A folder for its owner alone, that goes with all that is in it when this object does. Main thread.
#pragma once

#include <string>

namespace app {

class PrivateFolder {
 public:
  /// Named `beginning` and six letters. Throws UsageError: none can be made there; `name` of what it is for.
  PrivateFolder(const std::string& beginning, const std::string& name);
  ~PrivateFolder();
  PrivateFolder(const PrivateFolder&) = delete;
  PrivateFolder& operator=(const PrivateFolder&) = delete;

  /// Absolute, as other programs and addresses want it.
  const std::string& path() const { return path_; }
  std::string file(const std::string& name) const { return path_ + "/" + name; }

 private:
  std::string path_;
};

}  // namespace app
