#include "rendered_svg.hpp"

#include <cairo-pdf.h>
#include <cairo.h>
#include <fmt/format.h>
#include <librsvg/rsvg.h>
#include <ddacontact/output/output_error.hpp>
#include <ddacontact/output/whole_file.hpp>

#include <cmath>
#include <memory>

namespace dda {

namespace {

constexpr double dots_per_pixel = 2;           // of PNG
constexpr double points_per_pixel = 72. / 96;  // of PDF

using Document = std::unique_ptr<RsvgHandle, decltype(&g_object_unref)>;
using Surface = std::unique_ptr<cairo_surface_t, decltype(&cairo_surface_destroy)>;
using Context = std::unique_ptr<cairo_t, decltype(&cairo_destroy)>;

[[noreturn]] void fail(const std::string& path, const char* reason) {
  throw ddacontact::OutputError(fmt::format("cannot write \"{}\": {}", path, reason));
}

/// The message of an error, which is freed.
[[noreturn]] void fail(const std::string& path, GError* error) {
  const std::string reason = error != nullptr ? error->message : "librsvg gives no reason";
  g_clear_error(&error);
  fail(path, reason.c_str());
}

Document parsed(const std::string& path, const std::string& svg) {
  GError* error = nullptr;
  Document document(
      rsvg_handle_new_from_data(reinterpret_cast<const guint8*>(svg.data()), svg.size(), &error),
      g_object_unref);
  if (!document) fail(path, error);
  return document;
}

/// Draws the document, white behind it, so many units of the surface a pixel.
void render(const std::string& path, RsvgHandle* document, cairo_surface_t* surface, double width,
            double height) {
  const Context context(cairo_create(surface), cairo_destroy);
  cairo_set_source_rgb(context.get(), 1, 1, 1);
  cairo_paint(context.get());
  const RsvgRectangle whole{0, 0, width, height};
  GError* error = nullptr;
  if (rsvg_handle_render_document(document, context.get(), &whole, &error) == FALSE) fail(path, error);
}

struct Size {
  double width = 0, height = 0;  ///< pixels
};

Size size_of(const std::string& path, RsvgHandle* document) {
  Size size;
  if (rsvg_handle_get_intrinsic_size_in_pixels(document, &size.width, &size.height) == FALSE)
    fail(path, "the picture has no size");
  return size;
}

/// Takes what cairo writes, which would not notice a full disk.
cairo_status_t append(void* bytes, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(bytes)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

void expect_success(const std::string& path, cairo_status_t status) {
  if (status != CAIRO_STATUS_SUCCESS) fail(path, cairo_status_to_string(status));
}

}  // namespace

bool can_render_svg() {
  return true;
}

void write_png(const std::string& path, const std::string& svg) {
  const Document document = parsed(path, svg);
  const Size size = size_of(path, document.get());
  const double width = std::ceil(dots_per_pixel * size.width),
               height = std::ceil(dots_per_pixel * size.height);
  const Surface surface(
      cairo_image_surface_create(CAIRO_FORMAT_RGB24, static_cast<int>(width), static_cast<int>(height)),
      cairo_surface_destroy);
  expect_success(path, cairo_surface_status(surface.get()));
  render(path, document.get(), surface.get(), width, height);
  std::string bytes;
  expect_success(path, cairo_surface_write_to_png_stream(surface.get(), append, &bytes));
  ddacontact::write_whole(path, [&](std::ostream& out) { out << bytes; });
}

void write_pdf(const std::string& path, const std::string& svg) {
  const Document document = parsed(path, svg);
  const Size size = size_of(path, document.get());
  const double width = points_per_pixel * size.width, height = points_per_pixel * size.height;
  std::string bytes;
  const Surface surface(cairo_pdf_surface_create_for_stream(append, &bytes, width, height),
                        cairo_surface_destroy);
  expect_success(path, cairo_surface_status(surface.get()));
  render(path, document.get(), surface.get(), width, height);
  cairo_surface_finish(surface.get());
  expect_success(path, cairo_surface_status(surface.get()));
  ddacontact::write_whole(path, [&](std::ostream& out) { out << bytes; });
}

}  // namespace dda
