#include <ddacontact/scene/writer.hpp>

#include <ddacontact/scene/document_of.hpp>
#include <ddacontact/scene/schema.hpp>
#include <ddacontact/scene/value_text.hpp>

#include <ostream>

namespace ddacontact {

namespace scene_format {

namespace {

class DocumentWriter {
 public:
  explicit DocumentWriter(std::ostream& out) : out_(out) {}

  template <class T>
  void operator()(const Key& key, const T& value) {
    out_ << key.name << " = " << value_text(value) << '\n';
  }
  template <class T>
  void operator()(const Key& key, const std::optional<T>& value) {
    if (value) (*this)(key, *value);
  }
  void operator()(const Key&, const Parameters&) {}
  void operator()(const Key&, const OfTheWholeRun&) {}
  void operator()(const Key&, const OfStages&) {}

  template <class Record>
  void table(const Key& key, Record& record) {
    out_ << "\n[" << key.name << "]\n";
    describe(record, *this);
  }
  /// A domain is written as the blocks that it was cut into.
  void table(const Key&, std::optional<DomainRecord>&) {}
  template <class Record>
  void table(const Key& key, std::optional<Record>& record) {
    if (record) table(key, *record);
  }
  template <class Record>
  void tables(const Key& key, std::vector<Record>& records) {
    for (Record& record : records) {
      out_ << "\n[[" << key.name << "]]\n";
      describe(record, *this);
    }
  }

 private:
  std::ostream& out_;
};

}  // namespace

}  // namespace scene_format

void write_scene(std::ostream& out, const Scene& scene) {
  scene_format::Document document = scene_format::document_of(scene);
  scene_format::DocumentWriter writer(out);
  describe(document, writer);
}

}  // namespace ddacontact
