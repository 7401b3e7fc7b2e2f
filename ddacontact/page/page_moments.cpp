#include <ddacontact/page/page_moments.hpp>

#include <ddacontact/page/byte_text.hpp>
#include <ddacontact/page/moment_coder.hpp>
#include <ddacontact/page/page_contacts.hpp>

#include <algorithm>

namespace ddacontact {

namespace {

/// A quarter of a thousandth of the largest number of a block; a block that moved far still has its shape to
/// a four-thousandth of its size.
constexpr Quantization::Resolution of_displacement{.bits = 12, .floor_bits = 18};
constexpr double of_size = 1. / 4096;
constexpr Quantization::Resolution of_others{.bits = 10, .floor_bits = 14},
    of_others_when_large{.bits = 8, .floor_bits = 12};
constexpr double of_gap = 1e-6;  ///< of the median block's size

std::vector<double> numbers_of(const Points& columns) {
  return {columns.data(), columns.data() + columns.size()};
}

std::vector<double> stress_numbers(const PageFrame& frame) {
  std::vector<double> numbers;
  for (const CellStressFit& fit : frame.stress)
    for (const Vec3* part : {&fit.at_centre, &fit.change_x, &fit.change_y})
      numbers.insert(numbers.end(), part->data(), part->data() + 3);
  return numbers;
}

/// Sets the changes inside the cells of divided blocks to zero: zeros take hardly a byte.
void leave_changes_out(const std::vector<Range>& cells, std::vector<double>& stress) {
  for (const Range& of_block : cells)
    for (int c = of_block.first; of_block.count > 1 && c < of_block.end(); ++c)
      std::fill_n(stress.begin() + 9 * c + 3, 6, 0.);
}

/// Numbers of items at all moments, how finely they are kept, and their coder.
class Track {
 public:
  Track(const std::vector<Range>& groups, int n_components, Quantization::Resolution resolution,
        std::vector<double> coarsest = {})
      : quantization_(groups, n_components, resolution, std::move(coarsest)), coder_(groups, n_components) {}

  void add(std::vector<double> numbers) {
    quantization_.see(numbers);
    moments_.push_back(std::move(numbers));
  }
  void append_exponents(std::string& bytes) const {
    int before = 0;
    for (const int exponent : quantization_.exponents()) {
      append_integer(exponent - before, bytes);
      before = exponent;
    }
  }
  void append(std::size_t moment, std::string& bytes) {
    coder_.append(quantization_.round(moments_[moment]), bytes);
  }

 private:
  Quantization quantization_;
  MomentCoder coder_;
  std::vector<std::vector<double>> moments_;
};

std::vector<Range> single_items(int n) {
  std::vector<Range> groups;
  for (int k = 0; k < n; ++k) groups.push_back({k, 1});
  return groups;
}

double median(std::vector<double> numbers) {
  const auto middle = numbers.begin() + static_cast<std::ptrdiff_t>(numbers.size() / 2);
  std::nth_element(numbers.begin(), middle, numbers.end());
  return *middle;
}

}  // namespace

std::string moments_bytes(const std::vector<PageFrame>& frames, const PageShape& shape,
                          const PageArrays& arrays) {
  std::vector<double> coarsest;
  for (const double size : shape.sizes()) coarsest.push_back(of_size * size);
  const PageContacts contacts(frames);
  const std::vector<Range> each = single_items(contacts.n_contacts()), all{{0, contacts.n_contacts()}};

  const Quantization::Resolution& of_others_here = arrays.is_large ? of_others_when_large : of_others;
  Track displacement(shape.points(), 2, of_displacement, coarsest),
      velocity(shape.points(), 2, of_others_here), stress(shape.cells(), 9, of_others_here),
      force(each, 2, of_others_here),
      gap(all, 1, {.bits = 0, .floor_bits = 0}, {of_gap * median(shape.sizes())});
  MomentCoder states(each, 2);
  for (std::size_t f = 0; f < frames.size(); ++f) {
    displacement.add(numbers_of(frames[f].frame.position - shape.reference()));
    if (arrays.velocity) velocity.add(numbers_of(frames[f].frame.velocity));
    if (arrays.stress) {
      std::vector<double> numbers = stress_numbers(frames[f]);
      if (arrays.is_large) leave_changes_out(shape.cells(), numbers);
      stress.add(std::move(numbers));
    }
    force.add(contacts.forces(static_cast<int>(f)));
    gap.add(contacts.gaps(static_cast<int>(f)));
  }

  std::string bytes;
  displacement.append_exponents(bytes);
  if (arrays.velocity) velocity.append_exponents(bytes);
  if (arrays.stress) stress.append_exponents(bytes);
  contacts.append_table(bytes);
  force.append_exponents(bytes);
  gap.append_exponents(bytes);
  for (std::size_t f = 0; f < frames.size(); ++f) {
    displacement.append(f, bytes);
    if (arrays.velocity) velocity.append(f, bytes);
    if (arrays.stress) stress.append(f, bytes);
    states.append(contacts.states(static_cast<int>(f)), bytes);
    force.append(f, bytes);
    gap.append(f, bytes);
  }
  return bytes;
}

}  // namespace ddacontact
