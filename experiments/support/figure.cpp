#include "support/figure.hpp"

#include <fmt/format.h>
#include <gnuplot-iostream.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <system_error>

#include "support/files.hpp"

namespace reprise::experiments {

namespace {

namespace fs = std::filesystem;

/// A folder of our own for what gnuplot says.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::string pattern = (fs::temp_directory_path() / "reprise-figure-XXXXXX").string();
    if (::mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("cannot make a temporary folder.");
    path_ = pattern;
  }
  ~ScratchFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;

  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
};

/// The path in single quotes of the shell.
std::string shell_string(const fs::path& path) {
  std::string quoted = "'";
  for (const char c : path.string()) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

void run_gnuplot(const std::string& script, const std::string& picture) {
  const ScratchFolder scratch;
  const fs::path said = scratch.path() / "said";
  const fs::path status = scratch.path() / "status";
  // gnuplot reads a pipe byte by byte, which takes seconds for a large picture, but a file at once.
  const fs::path file = scratch.path() / "script";
  write_file(file, script);
  {
    // gnuplot-iostream does not tell how gnuplot ended, so the shell notes it. When gnuplot ends early, `cat` takes the
    // rest: the pipe must not break, as that would kill this program without a word.
    Gnuplot gnuplot(
        fmt::format("(gnuplot -d; echo $? > {}; cat > /dev/null) > {} 2>&1", shell_string(status), shell_string(said)));
    gnuplot << "load " << gnuplot_string(file.string()) << std::endl;
  }
  std::string message = read_file(said);
  while (message.ends_with('\n') || message.ends_with(' ')) message.pop_back();
  const std::string code = read_file(status);
  if (code != "0\n" || !message.empty()) {
    throw std::runtime_error(fmt::format("gnuplot could not draw {} (exit code {}): {}", picture,
                                         code.substr(0, code.find('\n')),
                                         message.empty() ? "it gave no reason." : message));
  }
}

constexpr const char* style = R"(
set encoding utf8
set linetype 1 lc rgb '#0072b2' lw 2 pt 7 ps 0.5
set linetype 2 lc rgb '#d55e00' lw 2 pt 5 ps 0.5
set linetype 3 lc rgb '#009e73' lw 2 pt 9 ps 0.5
set linetype 4 lc rgb '#cc79a7' lw 2 pt 11 ps 0.5
set linetype 5 lc rgb '#e69f00' lw 2 pt 13 ps 0.5
set linetype 6 lc rgb '#56b4e9' lw 2 pt 7 ps 0.5
set linetype 7 lc rgb '#000000' lw 2 pt 5 ps 0.5
set linetype 8 lc rgb '#8c8c8c' lw 2 pt 9 ps 0.5
set linetype cycle 8
set border 3 lw 1 lc rgb '#404040'
set tics nomirror out scale 0.6 textcolor rgb '#202020'
set grid lw 0.6 lc rgb '#e4e4e4'
set key outside bottom center horizontal samplen 2.5
set style textbox opaque noborder margins 0.4, 0.3 fillcolor rgb '#ffffff'
)";

}  // namespace

double round_step(double length, double most) {
  const double power = std::pow(10.0, std::floor(std::log10(length / most)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (factor * power * most >= length) return factor * power;
  }
  return 10.0 * power;
}

Figure::Figure(int width, int height) : width_(width), height_(height) {}

std::string Figure::add_data(const std::vector<std::vector<double>>& rows) {
  const std::string name = fmt::format("$data{}", ++data_count_);
  script_ += fmt::format("{} << END_OF_DATA\n", name);
  for (const std::vector<double>& row : rows) {
    for (std::size_t i = 0; i < row.size(); ++i) script_ += fmt::format("{}{}", i == 0 ? "" : " ", row[i]);
    script_ += '\n';
  }
  script_ += "END_OF_DATA\n";
  return name;
}

void Figure::add(std::string_view command) {
  script_ += command;
  script_ += '\n';
}

void Figure::write(const std::filesystem::path& file) const {
  const std::string extension = file.extension().string();
  const auto terminal = [&]() -> std::string {
    constexpr const char* common = "font 'DejaVu Sans,13' background '#ffffff' noenhanced";
    if (extension == ".svg") return fmt::format("svg size {},{} {}", width_, height_, common);
    // The png has two pixels to a point, with everything in it scaled alike.
    if (extension == ".png") {
      return fmt::format("pngcairo size {},{} fontscale 1.5 linewidth 2 pointscale 2 {}", 2 * width_, 2 * height_,
                         common);
    }
    if (extension == ".pdf") {
      // A point is 1/96 inch, as in the svg; gnuplot's font size is in 1/72 inch.
      return fmt::format("pdfcairo size {}in,{}in fontscale 0.75 {}", width_ / 96.0, height_ / 96.0, common);
    }
    throw std::logic_error(fmt::format("no picture is drawn with the extension '{}'", extension));
  }();
  replace_file(file, [&](const fs::path& beside) {
    run_gnuplot(fmt::format("set terminal {}\nset output {}\n{}{}\nunset output\n", terminal,
                            gnuplot_string(beside.string()), style, script_),
                file.string());
  });
}

const std::vector<std::string>& Figure::extensions() {
  static const std::vector<std::string> all{".svg", ".png", ".pdf"};
  return all;
}

std::vector<std::string> Figure::write(const std::filesystem::path& folder, const std::string& name) const {
  std::vector<std::string> files;
  for (const char* extension : {".svg", ".png"}) {
    files.push_back(name + extension);
    write(folder / files.back());
  }
  return files;
}

std::vector<std::vector<double>> outline_rows(const Table& points) {
  std::vector<std::vector<double>> rows;
  for (std::size_t i = 0; i <= points.rows(); ++i) {
    const std::size_t row = i % points.rows();
    rows.push_back({points.number(row, "x"), points.number(row, "y")});
  }
  return rows;
}

std::string gnuplot_string(std::string_view text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("''") : std::string(1, c);
  return quoted + "'";
}

}  // namespace reprise::experiments
