#pragma once

#include <deque>
#include <memory>
#include <streambuf>
#include <string>
#include <string_view>
#include <vector>

#include "engine/core/progress.h"
#include "engine/io/extension.h"

namespace mesher::app {

/// Which formats the person named.
struct FormatArguments {
  std::string format;        ///< of the pipe: "ply"
  std::string input_format;  ///< of the input
};

/// The names of a command's files. "-" becomes /dev/stdin or /dev/stdout.
struct StreamNames {
  std::vector<std::string*> inputs;  ///< models
  std::string* output = nullptr;     ///< null: the command writes none
  std::vector<std::string> formats;  ///< that the command writes: "obj", "ply"
  bool output_tells_format = false;  ///< whatever its name is
};

/// Returns the formats that a command writes, without dots.
std::vector<std::string> written_formats(std::string_view command);

/// Makes pipes usable like files while it lives. Gives them the formats that the person named, or,
/// to an input, the one that it begins like. An input that is a pipe is read into memory, unless it
/// is a progressive mesh, which is read as it arrives. If the output is stdout, what is printed
/// there goes to stderr.
class Streams {
 public:
  /// Throws UsageError if a format has to be named, or does not fit; InputError if an input does
  /// not begin like any format; Cancelled.
  Streams(const StreamNames& names, const FormatArguments& formats);
  ~Streams();
  Streams(const Streams&) = delete;
  Streams& operator=(const Streams&) = delete;

 private:
  void open_input(const std::string& file, const std::string& format);
  void name_format(const std::string& file, const std::string& format);

  std::deque<io::NamedFormat> named_;
  std::streambuf* stdout_ = nullptr;  ///< to be restored
};

/// Throws UsageError if a file is a pipe, which `what` cannot use: "--measure".
void refuse_stream(const std::string& file, const std::string& what);

}  // namespace mesher::app
