#include "frame/experiment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "frame/provenance.hpp"
#include "reprise/io/interruption.hpp"

namespace reprise::experiments {

namespace fs = std::filesystem;

Session::Session(std::string program, fs::path out, bool parents, fs::path from, bool quick)
    : program_(std::move(program)), out_(std::move(out)), parents_(parents), from_(std::move(from)), quick_(quick) {}

std::string Session::file_stem(const std::string& part) const {
  return part.empty() ? program_ : program_ + "_" + part;
}

void Session::open() {
  if (lock_) return;
  make_folder(out_, parents_);
  lock_.emplace(out_, std::chrono::milliseconds(0));
  const fs::path mark = out_ / (program_ + ".json");
  std::error_code error;
  fs::remove(mark, error);
  if (error) throw std::runtime_error(fmt::format("cannot replace {}: {}.", mark.string(), error.message()));
}

Table Session::read(const std::string& program, const std::string& part) {
  const fs::path mark = from_ / program / (program + ".json");
  const fs::path path = from_ / program / ((part.empty() ? program : program + "_" + part) + ".csv");
  for (const fs::path& needed : {mark, path}) {
    if (!fs::exists(needed)) {
      throw std::runtime_error(
          fmt::format("{} is not there; run 'make experiment NAME={}' first.", needed.string(), program));
    }
  }
  if (std::find(inputs_.begin(), inputs_.end(), mark) == inputs_.end()) inputs_.push_back(mark);
  Table table = read_table(path);
  check_rows(mark, path.filename().string(), table.rows());
  return table;
}

void Session::write(const Table& table, const std::string& part) {
  open();
  outputs_.push_back(file_stem(part) + ".csv");
  rows_[outputs_.back()] = table.rows();
  write_table(out_ / outputs_.back(), table);
}

fs::path Session::store(const fs::path& file, std::string_view content) {
  open();
  const fs::path path = out_ / file;
  if (file.has_parent_path()) make_folder(path.parent_path(), true);
  write_file(path, content);
  outputs_.push_back(file.generic_string());
  return path;
}

Table Session::table(const std::string& part) const {
  const fs::path path = out_ / (file_stem(part) + ".csv");
  if (!fs::exists(path)) {
    throw std::runtime_error(fmt::format("{} is not there, so there is nothing to draw.", path.string()));
  }
  Table table = read_table(path);
  const fs::path mark = out_ / (program_ + ".json");
  if (fs::exists(mark)) check_rows(mark, path.filename().string(), table.rows());
  return table;
}

void Session::draw(const Figure& figure, const std::string& part) {
  for (const std::string& file : figure.write(out_, file_stem(part))) outputs_.push_back(file);
}

Experiment::Experiment(const ManifestEntry& entry)
    : program_(entry.program),
      title_(entry.title),
      options_(program_, title_),
      out_(fs::path("build/results") / program_) {
  options_.path("--out", out_, "folder of the results");
  options_.flag("--quick", quick_, "a shorter run, to see whether everything works");
}

void Experiment::reads_results() { options_.path("--from", from_, "folder of the results of other programs"); }

namespace {

/// Throws where what was printed has not reached its reader.
void flush_standard_output() {
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return;
  throw std::runtime_error(
      fmt::format("cannot write to standard output: {}.", std::error_code(errno, std::generic_category()).message()));
}

}  // namespace

int Experiment::run(int argc, const char* const* argv, const std::function<void(Session&)>& compute,
                    const std::function<void(Session&)>& draw) {
  options_.flag("--redraw", redraw_, "only draw the pictures, from the tables stored in --out");
  return run(argc, argv, [&](Session& session) {
    if (!redraw_) compute(session);
    // What was found is said before a picture can fail.
    flush_standard_output();
    draw(session);
  });
}

int Experiment::run(int argc, const char* const* argv, const std::function<void(Session&)>& body) {
  const auto fail = [&](int code, const std::string& sentence) {
    fmt::print(stderr, "{}: {}{}\n", program_, sentence, sentence.ends_with('.') ? "" : ".");
    return code;
  };
  handle_interruptions();
  try {
    if (prepare_) prepare_(options_);
    const fs::path usual = out_;
    if (!options_.parse(argc, argv)) {
      fmt::print("{}", options_.help());
      flush_standard_output();
      return 0;
    }
    const bool parents = out_ == usual;
    if (const std::string obstacle = obstacle_to_folder(out_, parents); !obstacle.empty()) {
      throw UsageError(fmt::format("--out is '{}', but {}.", out_.string(), obstacle));
    }
    const auto begin = std::chrono::steady_clock::now();
    Session session(program_, out_, parents, from_, quick_);
    body(session);
    flush_standard_output();
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;

    if (!session.lock_) return 0;  // the user asked for something else than results
    const fs::path record = out_ / (program_ + ".json");
    session.outputs_.push_back(record.filename().string());
    write_provenance(record, {program_, title_, options_.values(), session.inputs_, session.outputs_, session.rows_,
                              session.measured_, session.constants_, seconds.count()});
    return 0;
  } catch (const UsageError& error) {
    return fail(2, error.what());
  } catch (const std::invalid_argument& error) {
    return fail(2, error.what());
  } catch (const std::exception& error) {
    return fail(1, error.what());
  }
}

}  // namespace reprise::experiments
