#pragma once

// One run of the program gnuplot, which depends on nothing but PATH, and leaves nothing behind.

#include <chrono>
#include <string>
#include <string_view>
#include <vector>

namespace reprise {

/// What a run of gnuplot left.
struct GnuplotRun {
  std::string output;  ///< what it wrote to its standard output, such as a picture
  std::string said;    ///< what it wrote to its standard error, on one line
};

/// Runs gnuplot on a script; an empty one is not given to it. Without `set output`, pictures go to its standard output.
///
/// gnuplot's environment holds a UTF-8 locale, the paths of programs and libraries, and a folder for the cache of
/// fonts, nothing else: neither the language, the fonts and the settings of whoever runs it, nor a terminal. All files
/// are in memory, so that there are no temporary files and no names that anything could read as a command.
///
/// Throws std::runtime_error, with a sentence that begins with "gnuplot", when there is no gnuplot, when it ends with
/// another exit code than 0, or takes longer than the limit: it is killed then, with its children.
GnuplotRun run_gnuplot(const std::vector<std::string>& arguments, std::string_view script,
                       std::chrono::milliseconds limit);

}  // namespace reprise
