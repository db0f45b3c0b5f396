#include "accel/range_query.h"

namespace quincunx {

IntervalQuery::IntervalQuery(std::span<const std::uint8_t> set) : begun_(set.size()), ended_(set.size()) {
  assert(!set.empty() && set.size() <= 65536);
  std::uint16_t begun = 0, ended = 0;
  for (std::size_t n = 0; n < set.size(); ++n) {
    const bool before = n > 0 && set[n - 1], now = set[n];
    begun = std::uint16_t(begun + (now && !before));
    ended = std::uint16_t(ended + (before && !now));
    begun_[n] = begun;
    ended_[n] = ended;
  }
}

TableQuery::TableQuery(std::span<const std::uint8_t> set) : words_((set.size() + 63) / 64), bits_(set.size() * words_) {
  assert(!set.empty());
  std::size_t next = set.size();  // the first entry that is set at or after `first`: the row's bits from there on
  for (std::size_t first = set.size(); first-- > 0;) {
    if (set[first]) next = first;
    if (next == set.size()) continue;
    std::uint64_t* row = bits_.data() + first * words_;
    row[next / 64] = ~std::uint64_t(0) << (next % 64);
    std::fill(row + next / 64 + 1, row + words_, ~std::uint64_t(0));
  }
}

TreeQuery::TreeQuery(std::span<const std::uint8_t> set) : nodes_(2 * set.size()) {
  assert(!set.empty());
  for (std::size_t n = 0; n < set.size(); ++n) nodes_[set.size() + n] = set[n] != 0;
  for (std::size_t n = set.size(); n-- > 1;) nodes_[n] = nodes_[2 * n] | nodes_[2 * n + 1];
}

std::vector<std::uint8_t> visible_entries(const Thresholds& thresholds) {
  std::vector<std::uint8_t> set;
  for (int first = 0; first < 65536; first += kNumbersOfAnEntry)
    set.push_back(thresholds.touches(std::uint16_t(first), std::uint16_t(std::min(first + kNumbersOfAnEntry, 65535))));
  return set;
}

}  // namespace quincunx
