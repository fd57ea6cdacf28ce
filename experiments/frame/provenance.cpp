#include "frame/provenance.hpp"

#include <fmt/chrono.h>
#include <fmt/format.h>

#include <Eigen/Core>
#include <boost/version.hpp>
#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <thread>

#include "build_information.hpp"
#include "reprise/io/files.hpp"
#include "reprise/io/gnuplot.hpp"

namespace reprise::experiments {

namespace {

using Json = nlohmann::ordered_json;

Json read_json(const std::filesystem::path& path) {
  try {
    return Json::parse(read_file(path));
  } catch (const Json::exception&) {
    throw std::runtime_error(fmt::format("{} is not JSON.", path.string()));
  }
}

Json source_state() {
  try {
    return read_json(build_information::source_state_file);
  } catch (const std::runtime_error&) {
    // The build folder was moved away; the results are no less right for it.
    return Json{{"commit", nullptr}, {"dirty", nullptr}};
  }
}

std::string gnuplot_version() {
  try {
    const std::string text = run_gnuplot({"--version"}, "", std::chrono::seconds(10)).output;
    return text.substr(0, text.find('\n'));
  } catch (const std::runtime_error&) {
    return "not installed";
  }
}

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  }
  return "unknown";
}

}  // namespace

void write_provenance(const std::filesystem::path& path, const Provenance& provenance) {
  Json options = Json::object();
  for (const auto& [name, value] : provenance.options) options[name] = Json::parse(value);

  Json inputs = Json::object();
  for (const std::filesystem::path& input : provenance.inputs) {
    const Json record = read_json(input);
    inputs[record.value("program", input.stem().string())] = {{"source", record.value("source", Json())},
                                                              {"options", record.value("options", Json())}};
  }

  const Json record = {
      {"program", provenance.program},
      {"title", provenance.title},
      {"options", options},
      {"source", source_state()},
      {"build",
       {{"type", build_information::type},
        {"compiler", build_information::compiler},
        {"flags", build_information::flags}}},
      {"libraries",
       {{"Eigen", fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION)},
        {"Boost", fmt::format("{}.{}.{}", BOOST_VERSION / 100000, BOOST_VERSION / 100 % 1000, BOOST_VERSION % 100)},
        {"NLopt", build_information::nlopt_version},
        {"Ipopt", build_information::ipopt_version},
        {"SuiteSparse", build_information::suitesparse_version},
        {"gnuplot", gnuplot_version()}}},
      {"processor", processor()},
      {"cores", std::thread::hardware_concurrency()},
      {"finished", fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::chrono::system_clock::now()))},
      {"seconds", provenance.seconds},
      {"measured", provenance.measured},
      {"constants", provenance.constants},
      {"inputs", inputs},
      {"outputs", provenance.outputs},
      {"rows", provenance.rows},
  };
  write_file(path, record.dump(2) + "\n");
}

void check_rows(const std::filesystem::path& record, const std::string& file, std::size_t rows) {
  const Json content = read_json(record);
  const Json written = content.is_object() ? content.value("rows", Json::object()) : Json::object();
  const std::string path = (record.parent_path() / file).string();
  const std::string again = fmt::format("run 'make experiment NAME={}' again", record.stem().string());
  if (!written.contains(file)) {
    throw std::runtime_error(fmt::format("{} does not say how many rows {} has; {}.", record.string(), path, again));
  }
  if (written.at(file) != rows) {
    throw std::runtime_error(
        fmt::format("{} has {} rows, but had {} when it was written; {}.", path, rows, written.at(file).dump(), again));
  }
}

}  // namespace reprise::experiments
