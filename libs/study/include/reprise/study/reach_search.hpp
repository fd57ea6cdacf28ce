#pragma once

// Whether any design near a start reaches the prescribed workspace: found out in a fraction of a second, before an
// optimizer spends minutes on a problem that has no solution.

#include <Eigen/Core>
#include <functional>
#include <string>
#include <vector>

#include "reprise/study/synthesis_run.hpp"
#include "reprise/synthesis/relaxation.hpp"

namespace reprise {

/// What searches for reach use: SLSQP, whose quadratic programs are small here.
const Solver& reach_solver();

/// The least violation near a start, both in units of scaled.unit. Ends soon after `stop` (which may be empty, here and
/// below) says true.
LeastViolation search_reach(const ScaledProblem& scaled, const Eigen::VectorXd& start,
                            const std::function<bool()>& stop);

/// Whether it is none.
bool reaches(const LeastViolation& least);

/// The starts of searches for reach: the file's design and random ones.
std::vector<Eigen::VectorXd> reach_starts(const ScaledProblem& scaled, long seed);

/// `solve` from a start, where a design near it reaches the workspace: from that design too, where the run from the
/// start ends at one that does not. Elsewhere the design with the least violation, which no optimizer is asked about.
SynthesisOutcome solve_where_reached(const ScaledProblem& scaled, const std::string& optimizer,
                                     const Eigen::VectorXd& start, const std::function<bool()>& stop,
                                     const std::function<SynthesisOutcome(const Eigen::VectorXd&)>& solve);

/// The same from the first of reach_starts that leads to a design that reaches the workspace, beginning at that design;
/// where none does, the one with the least violation of all.
SynthesisOutcome solve_from_further_starts(const ScaledProblem& scaled, const std::string& optimizer, long seed,
                                           const std::function<bool()>& stop,
                                           const std::function<SynthesisOutcome(const Eigen::VectorXd&)>& solve);

}  // namespace reprise
