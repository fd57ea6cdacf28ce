#pragma once

// The one place that chooses the sparse QR factorisation: SuiteSparse's SPQR, or Eigen's own where the option
// REPRISE_SUITESPARSE is off. Eigen's is slower on large matrices and needs nothing else.

#include <Eigen/SparseCore>

#ifdef REPRISE_SUITESPARSE
#include <Eigen/SPQRSupport>
#else
#include <Eigen/OrderingMethods>
#include <Eigen/SparseQR>
#endif

namespace reprise {

using SparseColumns = Eigen::SparseMatrix<double, Eigen::ColMajor>;

#ifdef REPRISE_SUITESPARSE
using SparseQr = Eigen::SPQR<SparseColumns>;
#else
using SparseQr = Eigen::SparseQR<SparseColumns, Eigen::COLAMDOrdering<int> >;
#endif

}  // namespace reprise
