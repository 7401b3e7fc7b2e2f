#include <ddacontact/time/run_record.hpp>

#include <polyfem/core/error.hpp>

#include <cstring>
#include <type_traits>

namespace ddacontact {

namespace {

/// Appends what it is shown.
class Writer {
 public:
  template <class T>
  requires std::is_arithmetic_v<T> || std::is_enum_v<T>
  void operator()(const T& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); }
  void operator()(const std::string& text) {
    (*this)(text.size());
    bytes += text;
  }
  template <class Derived>
  void operator()(const Eigen::PlainObjectBase<Derived>& m) {
    (*this)(m.rows());
    (*this)(m.cols());
    bytes.append(reinterpret_cast<const char*>(m.data()),
                 sizeof(double) * static_cast<std::size_t>(m.size()));
  }
  template <class T, class Visit>
  void list(const std::vector<T>& items, Visit&& visit) {
    (*this)(items.size());
    for (const T& item : items) visit(item);
  }

  std::string bytes;
};

/// Fills what it is shown.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : bytes_(bytes) {}

  template <class T>
  requires std::is_arithmetic_v<T> || std::is_enum_v<T>
  void operator()(T& value) { std::memcpy(&value, take(sizeof value), sizeof value); }
  void operator()(std::string& text) {
    const std::size_t size = read_size(1);
    text.assign(take(size), size);
  }
  template <class Derived>
  void operator()(Eigen::PlainObjectBase<Derived>& m) {
    Index rows = 0, cols = 0;
    (*this)(rows);
    (*this)(cols);
    const bool fits = rows >= 0 && cols >= 0 &&
                      (Derived::RowsAtCompileTime == Eigen::Dynamic || rows == Derived::RowsAtCompileTime) &&
                      (Derived::ColsAtCompileTime == Eigen::Dynamic || cols == Derived::ColsAtCompileTime) &&
                      (cols == 0 || static_cast<std::size_t>(rows) <=
                                        bytes_.size() / sizeof(double) / static_cast<std::size_t>(cols));
    if (!fits) fail();
    m.resize(rows, cols);
    const std::size_t size = sizeof(double) * static_cast<std::size_t>(m.size());
    if (size > 0) std::memcpy(m.data(), take(size), size);
  }
  template <class T, class Visit>
  void list(std::vector<T>& items, Visit&& visit) {
    items.resize(read_size(1));
    for (T& item : items) visit(item);
  }
  void expect_end() const {
    if (!bytes_.empty()) fail();
  }

 private:
  [[noreturn]] static void fail() { throw Error("not the record of a run"); }
  const char* take(std::size_t size) {
    if (size > bytes_.size()) fail();
    const char* first = bytes_.data();
    bytes_.remove_prefix(size);
    return first;
  }
  /// The number of items of at least `item_size` bytes.
  std::size_t read_size(std::size_t item_size) {
    std::size_t size = 0;
    (*this)(size);
    if (size > bytes_.size() / item_size) fail();
    return size;
  }

  std::string_view bytes_;
};

template <class Archive, class Contact>
void visit_contact(Archive& visit, Contact& c) {
  visit(c.pair.vertex_block);
  visit(c.pair.vertex);
  visit(c.pair.edge_block);
  visit(c.pair.edge);
  visit(c.history.state);
  visit(c.history.lock);
  visit(c.history.gap_offset);
  visit(c.history.bonded);
  visit(c.history.length);
  visit(c.history.normal);
  visit(c.history.shear);
  visit(c.law.normal_stiffness);
  visit(c.law.tangential_stiffness);
  visit(c.law.cohesion);
  visit(c.law.tension);
  visit(c.end_gap);
  visit(c.end_slip);
  visit(c.normal);
  visit(c.shear);
  visit(c.was_closed);
  visit(c.augmented);
}

template <class Archive, class Counts>
void visit_counts(Archive& visit, Counts& c) {
  for (auto* count :
       {&c.steps, &c.substeps, &c.rejected, &c.overlap_rejections, &c.unconverged, &c.open_close_iterations,
        &c.linear_solves, &c.factorizations, &c.minimizations, &c.augmentations, &c.broken_bonds, &c.impacts,
        &c.limited_impacts, &c.unsettled_impacts, &c.frictionless_holds, &c.contacts_max, &c.contacts})
    visit(*count);
  visit(c.max_penetration);
  visit(c.max_residual);
}

template <class Archive, class Record>
void visit_record(Archive& visit, Record& r) {
  visit(r.step.steps);
  visit(r.step.begun);
  visit(r.step.substep);
  visit(r.step.progress.stage);
  visit(r.step.progress.steps);
  visit(r.step.progress.start_time);
  auto& state = r.step.state;
  visit(state.time);
  visit(state.origin);
  visit(state.position);
  visit(state.velocity);
  visit(state.acceleration);
  visit(state.stress);
  visit(state.rotation);
  visit.list(r.step.contacts, [&](auto& contact) { visit_contact(visit, contact); });
  visit_counts(visit, r.counts);
  EnergyLedger::visit_numbers(r.energy, visit);
  visit(r.last_dt);
  visit(r.end_time);
  visit(r.zero_position);
  visit(r.zero_origin);
  visit(r.reactions);
  visit.list(r.convex, [&](auto& convex) { visit(convex); });
  visit.list(r.notes, [&](auto& note) { visit(note); });
  visit(r.last_unsettled);
}

}  // namespace

std::string to_bytes(const RunRecord& record) {
  Writer writer;
  visit_record(writer, record);
  return std::move(writer.bytes);
}

RunRecord run_record_from(std::string_view bytes) {
  Reader reader(bytes);
  RunRecord record;
  visit_record(reader, record);
  reader.expect_end();
  return record;
}

}  // namespace ddacontact
