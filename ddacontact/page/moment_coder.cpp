#include <ddacontact/page/moment_coder.hpp>

#include <ddacontact/page/byte_text.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace ddacontact {

namespace {

constexpr int least_exponent = -200, largest_exponent = 200;
constexpr double most_steps = 1 << 29;  // differences of two of them, twice, fit into 32 bits

std::size_t n_bytes(const std::vector<std::int32_t>& numbers) {
  std::size_t sum = 0;
  for (const std::int32_t number : numbers) {
    const auto size = static_cast<std::uint32_t>(number < 0 ? ~number : number);
    for (std::uint32_t rest = size; rest != 0; rest >>= 1) ++sum;  // in bits: what deflate will make of it
  }
  return sum;
}

int exponent_of(double step) {
  if (!(step > 0)) return least_exponent;
  return std::clamp(static_cast<int>(std::floor(std::log2(step))), least_exponent, largest_exponent);
}

}  // namespace

MomentCoder::MomentCoder(const std::vector<Range>& groups, int n_components) : n_components_(n_components) {
  for (const Range& group : groups)
    for (int item = 0; item < group.count; ++item) is_first_.push_back(item == 0);
  before_.assign(is_first_.size() * static_cast<std::size_t>(n_components), 0);
}

std::vector<std::int32_t> MomentCoder::differences(const std::vector<std::int32_t>& numbers, int mode) const {
  std::vector<std::int32_t> change = numbers;
  if ((mode & 1) != 0)
    for (std::size_t k = 0; k < change.size(); ++k) change[k] -= before_[k];
  if ((mode & 2) == 0) return change;
  const auto n = static_cast<std::size_t>(n_components_);
  for (std::size_t item = is_first_.size(); item-- > 1;)
    if (!is_first_[item])
      for (std::size_t c = 0; c < n; ++c) change[item * n + c] -= change[(item - 1) * n + c];
  return change;
}

void MomentCoder::append(const std::vector<std::int32_t>& numbers, std::string& bytes) {
  std::vector<std::int32_t> best;
  std::size_t least = std::numeric_limits<std::size_t>::max();
  char best_mode = 0;
  for (int mode = 0; mode < 4; ++mode) {
    std::vector<std::int32_t> change = differences(numbers, mode);
    if (const std::size_t size = n_bytes(change); size < least) {
      least = size;
      best = std::move(change);
      best_mode = static_cast<char>(mode);
    }
  }
  bytes += best_mode;
  for (const std::int32_t number : best) append_integer(number, bytes);
  before_ = numbers;
}

Quantization::Quantization(std::vector<Range> groups, int n_components, Resolution resolution,
                           std::vector<double> coarsest)
    : groups_(std::move(groups)),
      n_components_(n_components),
      resolution_(resolution),
      coarsest_(std::move(coarsest)),
      largest_(groups_.size(), 0) {}

void Quantization::see(const std::vector<double>& numbers) {
  for (std::size_t g = 0; g < groups_.size(); ++g)
    for (int k = groups_[g].first * n_components_; k < groups_[g].end() * n_components_; ++k)
      largest_[g] = std::max(largest_[g], std::abs(numbers[static_cast<std::size_t>(k)]));
}

std::vector<int> Quantization::exponents() const {
  double largest = 0;
  for (const double of_group : largest_) largest = std::max(largest, of_group);
  const double floor = std::ldexp(largest, -resolution_.floor_bits);
  std::vector<int> exponents;
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    double step = std::max(std::ldexp(largest_[g], -resolution_.bits), floor);
    if (!coarsest_.empty()) step = std::min(step, coarsest_[g]);
    exponents.push_back(exponent_of(std::max(step, 2 * largest_[g] / most_steps)));
  }
  return exponents;
}

std::vector<std::int32_t> Quantization::round(const std::vector<double>& numbers) const {
  const std::vector<int> exponent = exponents();
  std::vector<std::int32_t> multiples(numbers.size(), 0);
  for (std::size_t g = 0; g < groups_.size(); ++g)
    for (int k = groups_[g].first * n_components_; k < groups_[g].end() * n_components_; ++k) {
      const auto i = static_cast<std::size_t>(k);
      const double multiple = std::round(std::ldexp(numbers[i], -exponent[g]));
      multiples[i] = static_cast<std::int32_t>(std::clamp(multiple, -most_steps, most_steps));
    }
  return multiples;
}

}  // namespace ddacontact
