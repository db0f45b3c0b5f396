// The folder that a command writes several files to.
#pragma once

#include <string>
#include <vector>

namespace quincunx {

/// Made if it is not there, and taken away again if nothing came into it.
class OutputFolder {
 public:
  /// Only looks. Throws InputError naming -o where `path` is no folder, or is not there and neither is the folder it would be in.
  explicit OutputFolder(std::string path);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  /// Makes the folder. Throws InputError unless the files of these names could be written to it now.
  void prepare(const std::vector<std::string>& names);
  /// The path of a file in it.
  std::string file(const std::string& name) const;

 private:
  std::string path_;
  bool made_ = false;
};

}  // namespace quincunx
