#include <ddacontact/picture/picture.hpp>

#include <ddacontact/picture/block_layer.hpp>
#include <ddacontact/picture/colour_bar.hpp>
#include <ddacontact/picture/field_layer.hpp>
#include <ddacontact/picture/grid.hpp>
#include <ddacontact/picture/legend.hpp>
#include <ddacontact/picture/panel_boxes.hpp>

#include <algorithm>
#include <memory>
#include <set>

namespace ddacontact {

namespace {

constexpr double title_size = 14.5, title_line = 19, bold_factor = 1.06, usual_bar_width = 62;

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
    needs_.width = options.width;
    needs_.height = options.height;
    for (const Panel& panel : panels) needs_.captions.push_back(panel.caption);
    title_ = wrapped(options.title, options.width - 2 * page_margin, bold_factor * title_size);
    if (!title_.empty()) needs_.above = static_cast<double>(title_.size()) * title_line + 5;
    choose_boxes();
    choose_columns();
    fill_panels();
    place();
  }

  std::string svg() {
    for (std::size_t line = 0; line < title_.size(); ++line)
      page_.text({page_margin, page_margin + title_size + static_cast<double>(line) * title_line},
                 title_[line], {.size = title_size, .bold = true});
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

  void choose_boxes() {
    for (const Panel& panel : panels_)
      needed_.push_back(options_.window ? *options_.window : bounding_box(*panel.frame, options_.reference));
    fit_panels();
  }

  void fit_panels() {
    std::vector<int> scenes;
    for (const Panel& panel : panels_) scenes.push_back(panel.scene);
    fit_ = fit_boxes(needed_, scenes);
    needs_.extents = fit_.extents;
    needs_.below_each = fit_.same_scale ? 0 : legend_line_height;
  }

  double scale_of(std::size_t panel) const { return grid_.scale / fit_.unit(panel); }

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
    needs_.columns = options_.columns > 0 ? std::min(options_.columns, static_cast<int>(panels_.size()))
                                          : best_columns(needs_);
  }

  int row_of(std::size_t panel) const { return static_cast<int>(panel) / needs_.columns; }

  bool share_colours(std::size_t i, std::size_t j) const {
    if (panels_[i].field != panels_[j].field) return false;
    return i == j || options_.sharing == RangeSharing::all ||
           (options_.sharing == RangeSharing::rows && row_of(i) == row_of(j));
  }

  void fill_panels() {
    grid_ = arrange(needs_);
    contents_.resize(panels_.size());
    for (std::size_t i = 0; i < panels_.size(); ++i) {
      const Panel& panel = panels_[i];
      if (has_numbers(panel.field))
        contents_[i].samples = std::make_unique<FieldSamples>(*panel.frame, panel.field, scale_of(i));
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
    for (std::size_t i = 0; i < panels_.size(); ++i)
      for (std::size_t k = 0; k < options_.vectors.size(); ++k)
        for (const Arrow& arrow : contents_[i].arrows[k]) {
          const Vec2 tip = arrow.from + pixels_per_unit_[k] / scale_of(i) * arrow.vector;
          if (tip.allFinite()) needed_[i] = united(needed_[i], {tip, tip});
        }
    fit_panels();
    grid_ = arrange(needs_);
  }

  void place() {
    for (std::size_t i = 0; i < panels_.size(); ++i) {
      needs_.bar_widths[i] = has_bar(i) ? colour_bar_width(*contents_[i].scale) : 0;
      if (has_bar(i))
        needs_.least_row_height = std::max(needs_.least_row_height, least_bar_height_of(*contents_[i].scale));
    }
    grid_ = arrange(needs_);
    choose_arrow_scales();
    if (!options_.window) include_arrows();
    make_legend();
    needs_.below = legend_lines(legend_, legend_width()) * legend_line_height;
    grid_ = arrange(needs_);
    for (const std::string& line : title_)
      least_width_ = std::max(least_width_, 2 * page_margin + text_width(line, bold_factor * title_size));
    for (const LegendItem& item : legend_)
      least_width_ = std::max(least_width_, 2 * page_margin + item.width);
  }

  double legend_width() const { return std::max(grid_.width, 300.) - 2 * page_margin; }

  void choose_arrow_scales() {
    double smallest = 1e9;
    for (std::size_t i = 0; i < panels_.size(); ++i)
      smallest = std::min(smallest, scale_of(i) * typical_size(*panels_[i].frame));
    const double longest_pixels = std::clamp(1.3 * smallest, 18., 60.);
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

  LegendItem scale_bar_of(std::size_t panel) const {
    return scale_bar(scale_of(panel), std::clamp(0.3 * grid_.drawing_width, 30., 120.));
  }

  void make_legend() {
    if (fit_.same_scale) legend_.push_back(scale_bar_of(0));
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
    const View view{fit_.boxes[i], grid_.corners[i], scale_of(i)};
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
    if (!fit_.same_scale)
      draw_legend(page_, view.corner + Vec2(0, view.size().y()), {scale_bar_of(i)}, grid_.drawing_width);
    if (has_bar(i))
      draw_colour_bar(page_, grid_.bar_corners[i], std::min(grid_.heights[i], most_bar_height),
                      *contents_[i].scale);
  }

  const std::vector<Panel>& panels_;
  const PictureOptions& options_;
  std::vector<Box> needed_;  ///< by each panel
  PanelBoxes fit_;
  GridNeeds needs_;
  Grid grid_;
  std::vector<Content> contents_;                  ///< of each panel
  std::vector<double> longest_, pixels_per_unit_;  ///< of each kind of vectors
  std::vector<LegendItem> legend_;
  std::vector<std::string> title_;  ///< its lines
  double least_width_ = 0;
  SvgPage page_;
};

}  // namespace

std::string draw(const std::vector<Panel>& panels, const PictureOptions& options) {
  return Picture(panels, options).svg();
}

}  // namespace ddacontact
