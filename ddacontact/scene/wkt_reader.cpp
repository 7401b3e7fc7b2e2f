#include <ddacontact/scene/polygon_builder.hpp>
#include <ddacontact/scene/spelling.hpp>
#include <ddacontact/scene/wkt_reader.hpp>
#include <ddacontact/scene/wkt_tokens.hpp>

#include <algorithm>
#include <utility>

namespace ddacontact::scene_format {

namespace {

constexpr int deepest_nesting = 64;
constexpr const char* expected_geometry = "expected POLYGON ((x y, ...)), MULTIPOLYGON or GEOMETRYCOLLECTION";

class WktReader {
 public:
  WktReader(const std::string& text, const std::shared_ptr<const std::string>& source, ProblemList& problems)
      : tokens_(text, source), problems_(problems) {}

  GeometryBlocks read() && {
    try {
      for (int index = 0; !tokens_.at_end(); ++index) {
        skip_reference_system();
        read_geometry("geometry " + std::to_string(index), 0);
      }
      file_.complete = true;
    } catch (const WktError& error) {
      const std::string found = error.token.text.empty() ? "the file ends too early"
                                                         : "not WKT at '" + excerpt(error.token.text) + "'";
      problems_.error(error.token.location, found, error.expected + "; the file is read no further");
    }
    return std::move(file_);
  }

 private:
  /// "SRID=4326;" before a geometry: a problem, once.
  void skip_reference_system() {
    if (capitals(tokens_.token().text) != "SRID") return;
    const WktToken srid = tokens_.take();
    tokens_.expect("=");
    const std::string number = tokens_.take().text;
    tokens_.expect(";");
    if (!std::exchange(has_reference_system_, true))
      problems_.error(srid.location, "the reference system 'SRID=" + excerpt(number) + "' is not read",
                      "coordinates are in m: leave 'SRID=...;' out everywhere");
  }

  /// A geometry with its word.
  void read_geometry(const std::string& title, int depth) {
    if (depth > deepest_nesting) tokens_.fail("no more than 64 geometries inside each other");
    if (!is_word(tokens_.token().text)) tokens_.fail(expected_geometry);
    const WktToken word = tokens_.take();
    std::string kind = capitals(word.text), measured = read_dimension(kind);
    if (!measured.empty())
      return skip(word, title, "has the dimension '" + measured + "'",
                  "geometry is two-dimensional: leave it out");
    if (kind == "POLYGON") return read_polygon(word.location, title);
    if (kind == "MULTIPOLYGON")
      return read_parts(word, title,
                        [&](const std::string& part) { read_polygon(tokens_.token().location, part); });
    if (kind == "GEOMETRYCOLLECTION")
      return read_parts(word, title, [&](const std::string& part) { read_geometry(part, depth + 1); });
    static const std::vector<std::string_view> known{"POLYGON", "MULTIPOLYGON", "GEOMETRYCOLLECTION"};
    static const std::vector<std::string_view> other{
        "POINT",          "MULTIPOINT",   "LINESTRING", "MULTILINESTRING",   "LINEARRING",
        "CIRCULARSTRING", "CURVEPOLYGON", "MULTICURVE", "POLYHEDRALSURFACE", "TIN",
        "TRIANGLE",       "MULTISURFACE"};
    const bool is_other = std::find(other.begin(), other.end(), kind) != other.end();
    if (!is_other && !tokens_.at("(") && capitals(tokens_.token().text) != "EMPTY")
      throw WktError{word, expected_geometry};
    skip(word, title, "is a '" + excerpt(word.text) + "'",
         is_other ? "only polygons make blocks: leave it out" : suggestion(kind, "geometry", known));
  }

  /// Takes Z, M or ZM from behind the word or out of it; returns the last two, which are not possible.
  std::string read_dimension(std::string& kind) {
    std::string dimension = capitals(tokens_.token().text);
    if (dimension == "Z" || dimension == "M" || dimension == "ZM") {
      tokens_.take();
    } else {
      dimension = kind.ends_with("ZM") ? "ZM" : kind.ends_with("GONZ") || kind.ends_with("IONZ") ? "Z" : "";
      kind.resize(kind.size() - dimension.size());
    }
    return dimension == "Z" ? "" : dimension;
  }

  bool take_empty() {
    if (capitals(tokens_.token().text) != "EMPTY") return false;
    tokens_.take();
    return true;
  }

  template <class ReadPart>
  void read_parts(const WktToken& word, const std::string& title, const ReadPart& read_part) {
    if (take_empty())
      return add_invalid(word.location, title, "is empty", "leave it out, or give it polygons");
    tokens_.expect("(");
    int index = 0;
    do {
      read_part("part " + std::to_string(index++) + " of " + title);
    } while (tokens_.take_if(","));
    tokens_.expect(")");
  }

  void read_polygon(const SourceLocation& location, const std::string& title) {
    PolygonBuilder polygon(title, location, problems_);
    if (!take_empty()) {
      tokens_.expect("(");
      do {
        polygon.begin_ring(tokens_.token().location);
        read_ring(polygon);
      } while (tokens_.take_if(","));
      tokens_.expect(")");
    }
    file_.blocks.push_back(std::move(polygon).finish());
  }

  void read_ring(PolygonBuilder& polygon) {
    if (take_empty()) return;
    tokens_.expect("(");
    std::vector<double> coordinates;
    do {
      const SourceLocation location = tokens_.token().location;
      coordinates.clear();
      while (const std::optional<double> number = number_of(tokens_.token().text)) {
        coordinates.push_back(*number);
        tokens_.take();
      }
      if (coordinates.empty()) tokens_.fail("expected the number x");
      if (!tokens_.at(",") && !tokens_.at(")")) tokens_.fail("expected a number, ',' or ')'");
      polygon.add_vertex(coordinates, location);
    } while (tokens_.take_if(","));
    tokens_.expect(")");
  }

  /// Says what is wrong with a geometry and steps over what stands in its brackets.
  void skip(const WktToken& word, const std::string& title, const std::string& what,
            const std::string& cure) {
    add_invalid(word.location, title, what, cure);
    if (take_empty()) return;
    int depth = 0;
    do {
      if (tokens_.at_end() || (depth == 0 && !tokens_.at("("))) tokens_.fail("expected '(' or ')'");
      depth += tokens_.at("(") ? 1 : tokens_.at(")") ? -1 : 0;
      tokens_.take();
    } while (depth > 0);
  }

  void add_invalid(const SourceLocation& location, const std::string& title, const std::string& what,
                   const std::string& cure) {
    PolygonBuilder polygon(title, location, problems_);
    polygon.refuse(location, what, cure);
    file_.blocks.push_back(std::move(polygon).finish());
  }

  WktTokens tokens_;
  ProblemList& problems_;
  GeometryBlocks file_;
  bool has_reference_system_ = false;
};

}  // namespace

GeometryBlocks read_wkt(const std::string& text, const std::shared_ptr<const std::string>& source,
                        ProblemList& problems) {
  return WktReader(text, source, problems).read();
}

}  // namespace ddacontact::scene_format
