/// \file Numbers of many items at successive moments, as differences that take few bytes.
#pragma once

#include <ddacontact/core/types.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace ddacontact {

/// Writes whole numbers, `n_components` for each item, moment after moment. Each moment is written as it is,
/// as differences in time, along the items of a group, or both: whichever takes the least. One byte tells
/// which (bit 0: time, bit 1: items); the numbers follow as `append_integer` writes them.
class MomentCoder {
 public:
  /// \param[in] groups  of the items: consecutive, differences do not cross their borders
  MomentCoder(const std::vector<Range>& groups, int n_components);

  /// Appends a moment.
  /// \param[in] numbers  of item after item
  void append(const std::vector<std::int32_t>& numbers, std::string& bytes);

 private:
  std::vector<std::int32_t> differences(const std::vector<std::int32_t>& numbers, int mode) const;

  int n_components_;
  std::vector<bool> is_first_;  ///< of its group: for each item
  std::vector<std::int32_t> before_;
};

/// Numbers as multiples of powers of two, one power for each group of items.
class Quantization {
 public:
  /// How finely numbers are told apart.
  struct Resolution {
    int bits = 10;        ///< of the largest number of a group
    int floor_bits = 14;  ///< of the largest of all: nothing is told apart below
  };

  /// \param[in] groups   of the items
  /// \param[in] coarsest for each group a step that must not be exceeded; may be empty
  Quantization(std::vector<Range> groups, int n_components, Resolution resolution,
               std::vector<double> coarsest = {});

  /// Takes numbers that will be rounded into account; all of them before `round` is called.
  void see(const std::vector<double>& numbers);
  /// The exponents of two, one for each group.
  std::vector<int> exponents() const;
  /// Multiples of the powers of two.
  std::vector<std::int32_t> round(const std::vector<double>& numbers) const;

 private:
  std::vector<Range> groups_;
  int n_components_;
  Resolution resolution_;
  std::vector<double> coarsest_, largest_;
};

}  // namespace ddacontact
