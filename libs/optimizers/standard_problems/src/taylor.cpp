#include "taylor.hpp"

#include <algorithm>

namespace reprise::standard {

template <int order>
Taylor<order> Taylor<order>::variable(double value, int index, int n) {
  Taylor result(value);
  result.n_ = n;
  result.first_[static_cast<std::size_t>(index)] = 1.0;
  return result;
}

template <int order>
void Taylor<order>::add(const Taylor& a, double f_a, double f_aa) {
  n_ = std::max(n_, a.n_);
  for (int i = 0; i < a.n_; ++i) {
    first_[static_cast<std::size_t>(i)] += f_a * a.first(i);
    if constexpr (order == 2) {
      for (int j = 0; j <= i; ++j) second_[position(i, j)] += f_a * a.second(i, j) + f_aa * a.first(i) * a.first(j);
    }
  }
}

template <int order>
void Taylor<order>::add_mixed(const Taylor& a, const Taylor& b, double f_ab) {
  if constexpr (order == 2) {
    for (int i = 0; i < std::max(a.n_, b.n_); ++i) {
      for (int j = 0; j <= i; ++j) {
        second_[position(i, j)] += f_ab * (a.first(i) * b.first(j) + b.first(i) * a.first(j));
      }
    }
  }
}

template class Taylor<1>;
template class Taylor<2>;

}  // namespace reprise::standard
