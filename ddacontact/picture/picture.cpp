#include <ddacontact/picture/picture.hpp>

#include <ddacontact/picture/block_layer.hpp>
#include <ddacontact/picture/colour_bar.hpp>
#include <ddacontact/picture/grid.hpp>
#include <ddacontact/picture/panel_boxes.hpp>
#include <ddacontact/picture/panel_contents.hpp>
#include <ddacontact/picture/thrust_layer.hpp>
#include <ddacontact/picture/water_layer.hpp>

#include <algorithm>

namespace ddacontact {

namespace {

constexpr double title_size = 14.5, title_line = 19, bold_factor = 1.06, usual_bar_width = 62;

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
    point();
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
      needed_.push_back(options_.window ? *options_.window : with_reference(panel));
    fit_panels();
  }

  Window with_reference(const Panel& panel) const {
    const Window box = bounding_box(*panel.frame, false);
    return with_water(options_.reference ? united(box, bounding_box(panel.shown_values(), true)) : box,
                      panel.water);
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

  void fill_panels() {
    grid_ = arrange(needs_);
    std::vector<double> pixels_per_metre;
    for (std::size_t i = 0; i < panels_.size(); ++i) pixels_per_metre.push_back(scale_of(i));
    contents_ = make_contents(panels_, options_, pixels_per_metre, needs_.columns);
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
          const Vec2 tip = arrow.from + vectors_[k].pixels_per_unit / scale_of(i) * arrow.vector;
          if (tip.allFinite()) needed_[i] = united(needed_[i], {tip, tip});
        }
    fit_panels();
    grid_ = arrange(needs_);
  }

  void point() {
    for (std::size_t i = 0; i < panels_.size(); ++i) {
      needs_.bar_widths[i] = has_bar(i) ? colour_bar_width(*contents_[i].scale) : 0;
      if (has_bar(i))
        needs_.least_row_height = std::max(needs_.least_row_height, least_bar_height_of(*contents_[i].scale));
    }
    grid_ = arrange(needs_);
    vectors_ = vector_scales(contents_, options_.vectors, longest_arrow());
    if (!options_.window) include_arrows();
    for (int pass = 0; pass < 2; ++pass) {  // the legend takes room, and its samples are to scale
      legend_ = explanations(panels_, contents_, vectors_);
      explain_overlays();
      if (fit_.same_scale) legend_.insert(legend_.begin(), scale_bar_of(0));
      needs_.below = legend_lines(legend_, legend_width()) * legend_line_height;
      if (pass == 0) grid_ = arrange(needs_);
    }
    grid_.height = grid_.legend_top + needs_.below + page_margin;
    for (const std::string& line : title_)
      least_width_ = std::max(least_width_, 2 * page_margin + text_width(line, bold_factor * title_size));
    for (const LegendItem& item : legend_)
      least_width_ = std::max(least_width_, 2 * page_margin + item.width);
  }

  void explain_overlays() {
    std::vector<Water> waters;
    for (const Panel& panel : panels_) waters.push_back(panel.water);
    for (LegendItem& item : water_explanations(waters, fit_.boxes)) legend_.push_back(std::move(item));
    if (options_.thrust) legend_.push_back(thrust_explanation());
  }

  double legend_width() const { return std::max(grid_.width, 300.) - 2 * page_margin; }

  /// Somewhat longer than the blocks are large, px.
  double longest_arrow() const {
    double block = scale_of(0) * typical_size(*panels_[0].frame);
    for (std::size_t i = 1; i < panels_.size(); ++i)
      block = std::min(block, scale_of(i) * typical_size(*panels_[i].frame));
    return std::clamp(1.3 * block, 18., 60.);
  }

  LegendItem scale_bar_of(std::size_t panel) const {
    return scale_bar(scale_of(panel), std::clamp(0.3 * grid_.drawing_width, 30., 120.));
  }

  void draw_panel(std::size_t i) {
    const View view{fit_.boxes[i], grid_.corners[i], scale_of(i)};
    double y = grid_.corners[i].y() - 8 - static_cast<double>(grid_.captions[i].size() - 1) * caption_line;
    for (const std::string& line : grid_.captions[i]) {
      page_.text({grid_.corners[i].x(), y}, line, {.size = caption_size});
      y += caption_line;
    }
    if (options_.window) page_.begin_clipped(view.corner, view.size());
    draw_blocks(panels_[i], contents_[i], view);
    if (options_.window) page_.end_group();
    if (!fit_.same_scale)
      draw_legend(page_, view.corner + Vec2(0, view.size().y()), {scale_bar_of(i)}, grid_.drawing_width);
    if (has_bar(i))
      draw_colour_bar(page_, grid_.bar_corners[i], std::min(grid_.heights[i], most_bar_height),
                      *contents_[i].scale);
  }

  void draw_blocks(const Panel& panel, const PanelContent& content, const View& view) {
    const Frame& frame = *panel.frame;
    if (content.scale)
      content.samples->draw(page_, view, *content.scale);
    else if (panel.field == Field::none)
      draw_fill(page_, view, frame);
    else
      draw_kinds(page_, view, frame, panel.field);
    if (options_.reference) draw_reference(page_, view, panel.shown_values());
    draw_cell_edges(page_, view, frame);
    draw_outlines(page_, view, frame);
    draw_water(page_, view, panel.water);
    if (options_.thrust) draw_thrust(page_, view, frame);
    draw_bolts(page_, view, panel.bolts, largest_bolt_force(panels_));
    for (std::size_t k = 0; k < vectors_.size(); ++k)
      draw_arrows(page_, view, content.arrows[k], vectors_[k].kind, vectors_[k].pixels_per_unit);
    if (options_.names) draw_names(page_, view, frame, panel.block_names);
  }

  const std::vector<Panel>& panels_;
  const PictureOptions& options_;
  std::vector<Window> needed_;  ///< by each panel
  PanelBoxes fit_;
  GridNeeds needs_;
  Grid grid_;
  std::vector<PanelContent> contents_;  ///< of each panel
  std::vector<VectorScale> vectors_;    ///< of each kind
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
