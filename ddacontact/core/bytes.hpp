/// \file Numbers, text and arrays to bytes and back: one list of members serves both ways.
#pragma once

#include <ddacontact/core/types.hpp>
#include <polyfem/core/error.hpp>

#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace ddacontact {

/// Appends the bits of what it is shown, in the order of bytes of the machine.
class ByteWriter {
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

/// Fills what it is shown, in the same order. Throws Error when the bytes are not those of such things.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : bytes_(bytes) {}

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
  [[noreturn]] static void fail() { throw Error("not the bytes of what is read"); }
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

}  // namespace ddacontact
