#pragma once

// The proof that no design is better than a bound, as a tree of boxes of designs that another program can check.
//
// The designs are the boxes' points z = [q_1, q_2, q_3, y, r] (global_optimum.hpp), or, of base joints anywhere,
// z = [q_1, q_2, q_3, y_1, y_2, y_3, r]. The tree begins with the root box. Each node is a line of text; a node that
// splits its box is followed by the lines of both halves, the lower one first:
//     B i v                       splits variable i, from 0, at v
//     S                           q_1 >= q_2 throughout: legs 1 and 2, which are alike, may change places
//     Y                           y >= O'_y throughout: the mirror image in the horizontal line is as good
//     X                           q_3 <= O'_x throughout: so is the one in the vertical line, at the orientation 0
//     L leg side phi piece t      leg 1, 2 or 3 is too long (side 1) or too short (side -1) there, all over the box
//     N phi piece t               kappa^2 >= 1 / bound^2 there, all over the box
//     M n                         followed by n terms, each a line: all over the box
//         F lambda phi piece t        sum lambda (kappa^2 - 1 / bound^2) - sum mu slack >= 0 (> 0 where no term is F),
//         L mu leg side phi piece t   slack = l_max^2 - l^2 (side 1) or l^2 - l_min^2 (side -1)
// A design that reaches the workspace has no negative slack, so in each box that a line L, N or M ends, every design
// misses the workspace or has a kappa^-1 of at most the bound.
//
// phi counts the orientations from 0: of every range its one orientation, or its lower end, middle and upper end; N and
// F are at slices and ends only. The points are named by a piece of the outline, from 0, and t in [0, 1]. Ellipses,
// superellipses, circles and quarter ellipses have the quadrants, counter-clockwise from +x, as pieces; with
// (C, S) = ((1 - t^2), 2 t) / (1 + t^2), for a superellipse both to the power 2 / exponent, and each quadrant's own
// semi-axes a along x and b along y, the points are O' + (a C, b S), (-a S, b C), (-a C, -b S), (a S, -b C). Polygons
// have the edges as pieces, from vertex to vertex in the order in which they are given (a rectangle from its upper
// right corner to the upper left one), tables the steps from angle to angle, in both of which t is a share of the
// piece. Scale and rotation come after. Numbers are hexadecimal floating point, as printf writes them with %a.

#include <cstddef>
#include <string>
#include <vector>

#include "reprise/kinematics/manipulator.hpp"

namespace reprise {

/// Which limit of a leg's length.
enum class LegSide { too_short = -1, too_long = 1 };

/// A pose of the prescribed outline.
struct OutlinePose {
  std::size_t orientation = 0;  ///< phi: which orientation
  std::size_t piece = 0;        ///< of the outline
  double t = 0.0;               ///< in [0, 1], along the piece
};

/// One term of an inequality M.
struct CertificateTerm {
  bool is_limit;                     ///< L; else F
  double multiplier;                 ///< lambda or mu, positive
  OutlinePose pose;                  ///< where
  std::size_t leg = 0;               ///< of a limit, from 0
  LegSide side = LegSide::too_long;  ///< of a limit
};

/// What a line of a certificate does with its box.
enum class CertificateKind {
  split,          ///< B
  legs_alike,     ///< S
  mirrored_in_y,  ///< Y
  mirrored_in_x,  ///< X
  limit,          ///< L
  conditioning,   ///< N
  combination,    ///< M
};

/// A node of the tree.
struct CertificateNode {
  CertificateKind kind = CertificateKind::split;  ///< what it does
  int variable = 0;                               ///< of a split
  double at = 0.0;                                ///< of a split
  std::size_t lower = 0;                          ///< of a split: index of the node of the lower half
  std::size_t upper = 0;                          ///< of a split: index of that of the upper one
  double bound = 1.0;  ///< of a leaf: kappa^-1 is at most this in the box, 0 where none reaches; not in the text
  std::vector<CertificateTerm> terms;  ///< of a combination; of a limit or the conditioning one term, its multiplier 1
};

/// The proof of a bound.
struct BoundCertificate {
  std::vector<Interval> root;          ///< the root box, variable by variable
  std::vector<CertificateNode> nodes;  ///< the first is the root's
};

/// The tree as text, a line each node and term, as described at the head of this file.
std::string to_text(const BoundCertificate& certificate);

}  // namespace reprise
