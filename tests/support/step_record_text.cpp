#include <tests/support/step_record_text.hpp>

#include <polyfem/core/error.hpp>

#include <cstdlib>
#include <istream>
#include <limits>
#include <ostream>
#include <string>
#include <type_traits>

namespace support {

using namespace ddacontact;

namespace {

/// Whether a number of type T can be that.
template <class T>
bool fits(double value) {
  if constexpr (std::is_integral_v<T>)
    return value >= static_cast<double>(std::numeric_limits<T>::lowest()) &&
           value <= static_cast<double>(std::numeric_limits<T>::max());
  return true;
}

/// The numbers of a record in their order: the same list for writing and for reading.
template <class Stream>
class Numbers {
 public:
  explicit Numbers(Stream& stream) : stream_(stream) {}

  template <class T>
  void operator()(T& number) {
    if constexpr (std::is_base_of_v<std::ostream, Stream>) {
      stream_ << +number << ' ';
    } else {
      std::string word;
      stream_ >> word;
      char* end = nullptr;
      const double value = std::strtod(word.c_str(), &end);
      if (word.empty() || *end != 0 || !fits<T>(value))
        throw Error("not a step record: '" + word + "' where a number should be");
      number = static_cast<T>(value);
    }
  }
  template <class Matrix>
  void matrix(Matrix& m) {
    Index rows = m.rows(), cols = m.cols();
    (*this)(rows);
    (*this)(cols);
    if constexpr (!std::is_base_of_v<std::ostream, Stream>) m.resize(rows, cols);
    for (Index k = 0; k < m.size(); ++k) (*this)(m.data()[k]);
    end_line();
  }
  void end_line() {
    if constexpr (std::is_base_of_v<std::ostream, Stream>) stream_ << '\n';
  }

 private:
  Stream& stream_;
};

template <class Numbers, class Contact>
void contact_numbers(Numbers& numbers, Contact& contact) {
  int state = static_cast<int>(contact.history.state);
  numbers(contact.pair.vertex_block);
  numbers(contact.pair.vertex);
  numbers(contact.pair.edge_block);
  int edge = contact.pair.corner ? -1 - contact.pair.edge : contact.pair.edge;  // < 0: the corner
  numbers(edge);
  if constexpr (!std::is_const_v<Contact>) {
    contact.pair.corner = edge < 0;
    contact.pair.edge = edge < 0 ? -1 - edge : edge;
  }
  numbers(state);
  numbers(contact.history.lock);
  numbers(contact.history.gap_offset);
  numbers(contact.history.bonded);
  numbers(contact.history.length);
  numbers(contact.history.normal);
  numbers(contact.history.shear);
  numbers(contact.end_slip);
  numbers.end_line();
  if constexpr (!std::is_const_v<Contact>) contact.history.state = static_cast<ContactState>(state);
}

template <class Numbers, class Record>
void record_numbers(Numbers& numbers, Record& record) {
  numbers(record.steps);
  numbers(record.begun);
  numbers(record.substep);
  numbers(record.state.time);
  numbers(record.state.carried_dt);
  numbers.end_line();
  numbers.matrix(record.state.origin);
  numbers.matrix(record.state.position);
  numbers.matrix(record.state.velocity);
  numbers.matrix(record.state.carried);
  numbers.matrix(record.state.stress);
  numbers.matrix(record.state.rotation);
}

}  // namespace

void write_record(std::ostream& out, const StepRecord& record) {
  const auto flags = out.flags();
  out << std::hexfloat;
  Numbers<std::ostream> numbers(out);
  record_numbers(numbers, record);
  const std::size_t n_contacts = record.contacts.size();
  numbers(n_contacts);
  numbers.end_line();
  for (const ContactRecord& contact : record.contacts) contact_numbers(numbers, contact);
  numbers.matrix(record.state.coordinates);
  numbers.matrix(record.state.bolts);
  out.flags(flags);
}

StepRecord read_record(std::istream& in) {
  StepRecord record;
  Numbers<std::istream> numbers(in);
  record_numbers(numbers, record);
  std::size_t n_contacts = 0;
  numbers(n_contacts);
  record.contacts.resize(n_contacts);
  for (ContactRecord& contact : record.contacts) contact_numbers(numbers, contact);
  in >> std::ws;
  if (!in.eof()) numbers.matrix(record.state.coordinates);  // else it follows from the points
  in >> std::ws;
  if (!in.eof()) numbers.matrix(record.state.bolts);  // else there are none
  record.progress.steps = record.steps;
  return record;
}

}  // namespace support
