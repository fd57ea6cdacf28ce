#include "reprise/bounds/bound_certificate.hpp"

#include <array>
#include <charconv>
#include <cmath>

namespace reprise {
namespace {

void append_number(std::string& text, double number) {
  std::array<char, 40> digits;
  const std::to_chars_result end =
      std::to_chars(digits.data(), digits.data() + digits.size(), std::abs(number), std::chars_format::hex);
  text += std::signbit(number) ? " -0x" : " 0x";
  text.append(digits.data(), end.ptr);
}

void append_count(std::string& text, std::size_t number) {
  text += ' ';
  text += std::to_string(number);
}

void append_pose(std::string& text, const OutlinePose& pose) {
  append_count(text, pose.orientation);
  append_count(text, pose.piece);
  append_number(text, pose.t);
  text += '\n';
}

void append_limit(std::string& text, const CertificateTerm& term) {
  append_count(text, term.leg + 1);
  text += term.side == LegSide::too_long ? " 1" : " -1";
  append_pose(text, term.pose);
}

void append_term(std::string& text, const CertificateTerm& term) {
  text += term.is_limit ? 'L' : 'F';
  append_number(text, term.multiplier);
  if (term.is_limit) {
    append_limit(text, term);
  } else {
    append_pose(text, term.pose);
  }
}

void append_node(std::string& text, const CertificateNode& node) {
  switch (node.kind) {
    case CertificateKind::split:
      text += 'B';
      append_count(text, static_cast<std::size_t>(node.variable));
      append_number(text, node.at);
      text += '\n';
      return;
    case CertificateKind::legs_alike:
      text += "S\n";
      return;
    case CertificateKind::mirrored_in_y:
      text += "Y\n";
      return;
    case CertificateKind::mirrored_in_x:
      text += "X\n";
      return;
    case CertificateKind::limit:
      text += 'L';
      append_limit(text, node.terms.front());
      return;
    case CertificateKind::conditioning:
      text += 'N';
      append_pose(text, node.terms.front().pose);
      return;
    case CertificateKind::combination:
      text += 'M';
      append_count(text, node.terms.size());
      text += '\n';
      for (const CertificateTerm& term : node.terms) append_term(text, term);
      return;
  }
}

}  // namespace

std::string to_text(const BoundCertificate& certificate) {
  std::string text;
  std::vector<std::size_t> open;
  if (!certificate.nodes.empty()) open.push_back(0);
  while (!open.empty()) {
    const CertificateNode& node = certificate.nodes[open.back()];
    open.pop_back();
    append_node(text, node);
    if (node.kind != CertificateKind::split) continue;
    open.push_back(node.upper);
    open.push_back(node.lower);
  }
  return text;
}

}  // namespace reprise
