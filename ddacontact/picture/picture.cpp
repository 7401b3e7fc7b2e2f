#include <ddacontact/picture/picture.hpp>

#include <ddacontact/picture/block_layer.hpp>
#include <ddacontact/picture/colour_bar.hpp>
#include <ddacontact/picture/field_layer.hpp>
#include <ddacontact/picture/grid.hpp>
#include <ddacontact/picture/legend.hpp>
#include <ddacontact/picture/number_text.hpp>

#include <algorithm>
#include <memory>
#include <set>

namespace ddacontact {

namespace {

constexpr double title_size = 14.5, title_line = 24, usual_bar_width = 62;

bool has_numbers(Field field) {
  const FieldKind kind = description(field).kind;
  return kind == FieldKind::magnitude || kind == FieldKind::with_sign;
}

/// Everything of one panel that does not depend on where it stands.
struct Content {
  std::unique_ptr<FieldSamples> samples;  ///< of fields of numbers
  std::optional<ColourScale> scale;
  std::vector<std::vector<Arrow>> arrows;  ///< of each kind of the options
};

class Picture {
 public:
  Picture(const std::vector<Panel>& panels, const PictureOptions& options)
      : panels_(panels), options_(options) {
    check();
    needs_.n_panels = static_cast<int>(panels.size());
    needs_.width = options.width;
    needs_.height = options.height;
    for (const Panel& panel : panels) needs_.captions.push_back(panel.caption);
    if (!options.title.empty()) needs_.above = title_line;
    choose_box();
    choose_columns();
    fill_panels();
    place();
  }

  std::string svg() {
    if (!options_.title.empty())
      page_.text({page_margin, page_margin + title_size}, options_.title, {.size = title_size, .bold = true});
    for (std::size_t i = 0; i < panels_.size(); ++i) draw_panel(i);
    draw_legend(page_, {page_margin, grid_.legend_top}, legend_, legend_width());
    return page_.finish(std::max(grid_.width, least_width_), grid_.height);
  }

 private:
  void check() const {
    if (panels_.empty()) throw Error("a picture needs a panel");
    for (const Panel& panel : panels_) {
      if (!holds(*panel.frame, panel.field))
        throw Error("the frame does not hold the field \"" + std::string(description(panel.field).name) +
                    "\"");
      if (options_.reference && !holds(*panel.frame, Field::displacement))
        throw Error("the frame does not hold displacements, so the undeformed outlines are not known");
      for (const VectorKind kind : options_.vectors)
        if (!holds(*panel.frame, kind)) throw Error("the frame does not hold what the vectors are made of");
    }
  }

  void choose_box() {
    if (options_.window) {
      box_ = *options_.window;
    } else {
      box_ = bounding_box(*panels_[0].frame, options_.reference);
      for (const Panel& panel : panels_) box_ = united(box_, bounding_box(*panel.frame, options_.reference));
      box_ = padded(box_, 0.01);
    }
    needs_.extent = {box_.width(), box_.height()};
  }

  /// With bars of the usual width, since theirs is not known before the values are.
  void choose_columns() {
    bool of_one_field = true;
    for (const Panel& panel : panels_) {
      of_one_field = of_one_field && panel.field == panels_[0].field;
      needs_.bar_widths.push_back(has_numbers(panel.field) ? usual_bar_width : 0);
    }
    needs_.below = legend_line_height;
    if (of_one_field && options_.sharing != RangeSharing::none)
      std::fill(needs_.bar_widths.begin() + 1, needs_.bar_widths.end(), 0.);
    needs_.columns =
        options_.columns > 0 ? std::min(options_.columns, needs_.n_panels) : best_columns(needs_);
  }

  int row_of(std::size_t panel) const { return static_cast<int>(panel) / needs_.columns; }

  bool share_colours(std::size_t i, std::size_t j) const {
    if (panels_[i].field != panels_[j].field) return false;
    return i == j || options_.sharing == RangeSharing::all ||
           (options_.sharing == RangeSharing::rows && row_of(i) == row_of(j));
  }

  void fill_panels() {
    const double pixels_per_metre = arrange(needs_).scale;
    contents_.resize(panels_.size());
    for (std::size_t i = 0; i < panels_.size(); ++i) {
      const Panel& panel = panels_[i];
      if (has_numbers(panel.field))
        contents_[i].samples = std::make_unique<FieldSamples>(*panel.frame, panel.field, pixels_per_metre);
      for (const VectorKind kind : options_.vectors)
        contents_[i].arrows.push_back(arrows_of(*panel.frame, kind));
    }
    for (std::size_t i = 0; i < panels_.size(); ++i) {
      if (!contents_[i].samples) continue;
      ValueRange data = contents_[i].samples->range();
      for (std::size_t j = 0; j < panels_.size(); ++j)
        if (share_colours(i, j)) {
          data.low = std::min(data.low, contents_[j].samples->range().low);
          data.high = std::max(data.high, contents_[j].samples->range().high);
        }
      contents_[i].scale.emplace(panels_[i].field, data, options_.range ? &*options_.range : nullptr);
    }
  }

  /// A bar serves its panel and those before it in the row that have the same colours.
  bool has_bar(std::size_t i) const {
    if (!contents_[i].scale) return false;
    const bool last_in_row = i + 1 == panels_.size() || row_of(i + 1) != row_of(i);
    return last_in_row || contents_[i].scale != contents_[i + 1].scale;
  }

  /// Makes room for arrows that reach beyond the blocks.
  void include_arrows() {
    const Box blocks = box_;
    for (const Content& content : contents_)
      for (std::size_t k = 0; k < options_.vectors.size(); ++k) {
        const double reach = pixels_per_unit_[k] / grid_.scale;
        for (const Arrow& arrow : content.arrows[k]) {
          const Vec2 tip = arrow.from + reach * arrow.vector;
          if (tip.allFinite()) box_ = united(box_, {tip, tip});
        }
      }
    if (box_.low == blocks.low && box_.high == blocks.high) return;
    box_ = padded(box_, 0.005);
    needs_.extent = {box_.width(), box_.height()};
    grid_ = arrange(needs_);
  }

  void place() {
    for (std::size_t i = 0; i < panels_.size(); ++i) {
      needs_.bar_widths[i] = has_bar(i) ? colour_bar_width(*contents_[i].scale) : 0;
      if (has_bar(i)) needs_.least_row_height = contents_[i].scale->is_constant() ? 60 : least_bar_height;
    }
    grid_ = arrange(needs_);
    choose_arrow_scales();
    if (!options_.window) include_arrows();
    make_legend();
    needs_.below = legend_lines(legend_, legend_width()) * legend_line_height;
    grid_ = arrange(needs_);
    least_width_ = 0;
    if (!options_.title.empty())
      least_width_ = 2 * page_margin + text_width(options_.title, title_size) * 1.06;
    for (const LegendItem& item : legend_)
      least_width_ = std::max(least_width_, 2 * page_margin + item.width);
  }

  double legend_width() const { return std::max(grid_.width, 300.) - 2 * page_margin; }

  void choose_arrow_scales() {
    const double longest_pixels = std::clamp(1.3 * grid_.scale * typical_size(*panels_[0].frame), 18., 60.);
    for (std::size_t k = 0; k < options_.vectors.size(); ++k) {
      double longest = 0;
      for (const Content& content : contents_) longest = std::max(longest, largest(content.arrows[k]));
      longest_.push_back(longest);
      pixels_per_unit_.push_back(longest > 0 ? longest_pixels / longest : 0);
    }
  }

  bool any_look(std::size_t k, Arrow::Look look) const {
    for (const Content& content : contents_)
      for (const Arrow& arrow : content.arrows[k])
        if (arrow.look == look && arrow.vector.norm() * pixels_per_unit_[k] >= 1) return true;
    return false;
  }

  void make_legend() {
    legend_.push_back(scale_bar(grid_.scale, std::clamp(0.3 * grid_.drawing.x(), 30., 120.)));
    std::set<int> materials;
    for (const Panel& panel : panels_)
      if (panel.field == Field::material)
        for (const int material : panel.frame->materials)
          if (materials.insert(material).second)
            legend_.push_back(swatch(kind_colour(material),
                                     panel.frame->material_names[static_cast<std::size_t>(material)]));
    for (std::size_t k = 0; k < options_.vectors.size(); ++k) add_samples(k);
  }

  void add_samples(std::size_t k) {
    const VectorKind kind = options_.vectors[k];
    struct Sample {
      Arrow::Look look;
      const char* text;
    };
    const std::vector<Sample> samples =
        kind == VectorKind::contact_forces
            ? std::vector<Sample>{{Arrow::Look::plain, "contact force"},
                                  {Arrow::Look::slipping, "contact force, slipping"}}
        : kind == VectorKind::principal_stresses
            ? std::vector<Sample>{{Arrow::Look::compression, "compression"},
                                  {Arrow::Look::tension, "tension"}}
        : kind == VectorKind::velocity ? std::vector<Sample>{{Arrow::Look::plain, "velocity"}}
                                       : std::vector<Sample>{{Arrow::Look::plain, "displacement"}};
    for (const Sample& sample : samples)
      if (any_look(k, sample.look))
        legend_.push_back(arrow_sample(kind, sample.look, longest_[k], pixels_per_unit_[k], sample.text));
  }

  void draw_panel(std::size_t i) {
    const Panel& panel = panels_[i];
    const Frame& frame = *panel.frame;
    const View view{box_, grid_.corners[i], grid_.scale};
    double y = grid_.corners[i].y() - 8 - static_cast<double>(grid_.captions[i].size() - 1) * caption_line;
    for (const std::string& line : grid_.captions[i]) {
      page_.text({grid_.corners[i].x(), y}, line, {.size = caption_size});
      y += caption_line;
    }
    if (options_.window) page_.begin_clipped(view.corner, view.size());
    if (contents_[i].scale)
      contents_[i].samples->draw(page_, view, *contents_[i].scale);
    else if (panel.field == Field::none)
      draw_fill(page_, view, frame);
    else
      draw_kinds(page_, view, frame, panel.field);
    if (options_.reference) draw_reference(page_, view, frame);
    draw_outlines(page_, view, frame);
    for (std::size_t k = 0; k < options_.vectors.size(); ++k)
      draw_arrows(page_, view, contents_[i].arrows[k], options_.vectors[k], pixels_per_unit_[k]);
    if (options_.names) draw_names(page_, view, frame, panel.block_names);
    if (options_.window) page_.end_group();
    if (has_bar(i))
      draw_colour_bar(page_, grid_.bar_corners[i], std::min(grid_.row_height, most_bar_height),
                      *contents_[i].scale);
  }

  const std::vector<Panel>& panels_;
  const PictureOptions& options_;
  Box box_;
  GridNeeds needs_;
  Grid grid_;
  std::vector<Content> contents_;                  ///< of each panel
  std::vector<double> longest_, pixels_per_unit_;  ///< of each kind of vectors
  std::vector<LegendItem> legend_;
  double least_width_ = 0;
  SvgPage page_;
};

}  // namespace

std::string draw(const std::vector<Panel>& panels, const PictureOptions& options) {
  return Picture(panels, options).svg();
}

}  // namespace ddacontact
