// A directory of results that is there as a whole or not at all. Everything is written into DIR.partial-<pid>, which
// takes DIR's name at the end.
#pragma once

#include <string>
#include <vector>

namespace rastertlm::report {

class OutputDirectory {
 public:
  // Makes DIR.partial-<pid> and the directories above it, and removes the partial directories of DIR whose process is
  // gone. Throws InputError where DIR exists and holds neither a report.json nor a manifest.json of this program, and
  // OutputError where nothing can be written.
  explicit OutputDirectory(const std::string& directory);
  OutputDirectory(const OutputDirectory&) = delete;
  OutputDirectory& operator=(const OutputDirectory&) = delete;
  // Removes everything that was not committed, and the directories that were made above it.
  ~OutputDirectory();

  // Where to write the file of that name.
  std::string path(const std::string& name) const;

  // The partial directory becomes DIR. What DIR held is removed, but for its sub-directories: they are the results of
  // other runs. Throws OutputError, or InputError where something that is not ours has come to stand there in the
  // meantime.
  void commit();

  // From now on SIGINT and SIGTERM remove what is partial and end the process with 130 and 143, whatever it is doing.
  // To be called before any thread is started. A second call does nothing.
  static void remove_on_signals();

 private:
  std::string target_;  // DIR, without a slash at the end
  std::string partial_;
  std::vector<std::string> parents_;  // made by us, innermost first
  bool committed_ = false;
};

}  // namespace rastertlm::report
