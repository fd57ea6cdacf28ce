#pragma once

// The tables of the reference optima.

#include <limits>
#include <string>

#include "reference/optimum_search.hpp"
#include "reprise/io/table.hpp"
#include "reprise/synthesis/optimality_certificate.hpp"
#include "reprise/synthesis/semi_infinite.hpp"

namespace reprise::experiments {

/// One problem of the chapter.
struct Study {
  std::string table;
  std::string workspace;
  SynthesisTask task;
};

/// Both ways to the optimum, from the same start.
struct Agreement {
  SemiInfiniteResult exchange;
  SemiInfiniteResult discretised;
};

/// What is proved of a design.
struct Judged {
  OptimalityCertificate certificate;
  double lower = std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  double overreach = 0.0;   ///< no limit is violated by more than this, proved
  double throughout = 0.0;  ///< the same at every orientation from the lowest to the highest
  long evaluations = 0;
};

/// The tables of the program, with their columns.
struct ReferenceTables {
  Table designs;
  Table starts;
  Table agreement;
  Table sensitivities;
  Table claim;
  Table general;

  ReferenceTables();

  void add_design(const Study& study, const std::string& source, const std::string& formulation,
                  const Eigen::VectorXd& design, const Judged& judged, double reference);
  void add_starts(const Study& study, const Search& search);
  void add_agreement(const Study& study, const Search& search, const LocalOptimum& best, const Agreement& both);
  void add_sensitivities(const Study& study, const Eigen::VectorXd& design, const OptimalityCertificate& certificate);
};

}  // namespace reprise::experiments
