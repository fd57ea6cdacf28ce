#pragma once

// Figures drawn by gnuplot, in one style, as svg, png and pdf. Their bytes do not depend on the environment (those of a
// pdf on the time of day).

#include <chrono>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "reprise/io/table.hpp"

namespace reprise {

/// The colours of the house (Okabe and Ito's, distinguishable with all common kinds of colour blindness).
namespace colour {
inline constexpr const char* black = "#000000";      ///< outlines and text
inline constexpr const char* grey = "#8c8c8c";       ///< what stays in the background
inline constexpr const char* blue = "#0072b2";       ///< line type 1
inline constexpr const char* vermilion = "#d55e00";  ///< line type 2
inline constexpr const char* green = "#009e73";      ///< line type 3
inline constexpr const char* purple = "#cc79a7";     ///< line type 4
inline constexpr const char* orange = "#e69f00";     ///< line type 5
inline constexpr const char* sky = "#56b4e9";        ///< line type 6
}  // namespace colour

/// The smallest of 1, 2 or 5 times a power of ten that goes at most `most` times into a length > 0: a step for tics or
/// levels.
double round_step(double length, double most);

/// A gnuplot script with its data. The style of the house is set before the first command: white background, DejaVu
/// Sans, line types 1 to 8 in the colours above (blue, vermilion, green, purple, orange, sky, black, grey), light grid.
class Figure {
 public:
  /// Width and height in points; one point is one unit of the svg.
  Figure(int width, int height);

  /// Puts data into the script and returns the name ("$data1") under which commands use it. Every row is a list of
  /// numbers; an empty row is a blank line, which ends a curve or a scan line.
  std::string add_data(const std::vector<std::vector<double>>& rows);

  /// Appends a gnuplot command. Commands must neither set a terminal or an output nor wait for input.
  void add(std::string_view command);

  /// How long gnuplot may take for one picture before it is stopped; a minute unless this is called.
  void limit_time(std::chrono::milliseconds limit) { time_limit_ = limit; }

  /// Draws `<folder>/<name>.svg` and `<folder>/<name>.png` with the same commands and returns their file names. Each
  /// file appears whole or not at all, as write_file says. A picture is judged by gnuplot's exit code and by its end;
  /// what gnuplot says beside that is a warning, which is passed on to standard error. Throws std::runtime_error, in a
  /// sentence that names the file, when gnuplot is missing, fails, hangs, or leaves no whole picture, or when the file
  /// system refuses.
  std::vector<std::string> write(const std::filesystem::path& folder, const std::string& name) const;

  /// Draws one file, of the kind that its extension says: one of extensions(). Throws as above, and std::logic_error
  /// for another extension.
  void write(const std::filesystem::path& file) const;

  static const std::vector<std::string>& extensions();  ///< ".svg", ".png", ".pdf"

 private:
  int width_;
  int height_;
  int data_count_ = 0;
  std::chrono::milliseconds time_limit_ = std::chrono::minutes(1);
  std::string script_;
};

/// The columns x and y of a table as data of a closed outline: the first row comes again at the end.
std::vector<std::vector<double>> outline_rows(const Table& points);

/// The text as a string of gnuplot in single quotes.
std::string gnuplot_string(std::string_view text);

}  // namespace reprise
