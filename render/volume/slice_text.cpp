#include "render/volume/slice_text.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

#include <pango/pangocairo.h>

namespace render {
namespace {

constexpr double kLineOfFont = 1.17;
constexpr std::size_t kMostWords = 64;

struct Release {
  void operator()(PangoLayout* layout) const { g_object_unref(layout); }
  void operator()(PangoContext* context) const { g_object_unref(context); }
  void operator()(cairo_surface_t* surface) const { cairo_surface_destroy(surface); }
  void operator()(cairo_t* pen) const { cairo_destroy(pen); }
};

std::unique_ptr<PangoLayout, Release> layoutOfWord(const std::string& text, int line_px) {
  const std::unique_ptr<PangoContext, Release> context(
      pango_font_map_create_context(pango_cairo_font_map_get_default()));
  std::unique_ptr<PangoLayout, Release> layout(pango_layout_new(context.get()));
  PangoFontDescription* font = pango_font_description_from_string("DejaVu Sans");
  pango_font_description_set_absolute_size(font, line_px / kLineOfFont * PANGO_SCALE);
  pango_layout_set_font_description(layout.get(), font);
  pango_font_description_free(font);
  pango_layout_set_text(layout.get(), text.c_str(), -1);
  return layout;
}

WordPixels drawnWord(const std::string& text, int line_px) {
  constexpr int kRimWidth_px = 1;
  const std::unique_ptr<PangoLayout, Release> layout = layoutOfWord(text, line_px);
  WordPixels word;
  pango_layout_get_pixel_size(layout.get(), &word.size_px.x, &word.size_px.y);
  word.size_px = glm::max(word.size_px + 2 * kRimWidth_px, 1);
  const std::unique_ptr<cairo_surface_t, Release> surface(
      cairo_image_surface_create(CAIRO_FORMAT_A8, word.size_px.x, word.size_px.y));
  const std::unique_ptr<cairo_t, Release> pen(cairo_create(surface.get()));
  cairo_move_to(pen.get(), kRimWidth_px, kRimWidth_px);
  pango_cairo_show_layout(pen.get(), layout.get());
  cairo_surface_flush(surface.get());

  const unsigned char* const bytes = cairo_image_surface_get_data(surface.get());
  const int stride = cairo_image_surface_get_stride(surface.get());
  const auto at = [&](int x, int y) {
    const bool is_inside = x >= 0 && y >= 0 && x < word.size_px.x && y < word.size_px.y;
    return is_inside && bytes != nullptr ? bytes[y * stride + x] : std::uint8_t{0};
  };
  for (int y = 0; y < word.size_px.y; ++y)
    for (int x = 0; x < word.size_px.x; ++x) {
      word.letters.push_back(at(x, y));
      std::uint8_t most = 0;
      for (int dy = -kRimWidth_px; dy <= kRimWidth_px; ++dy)
        for (int dx = -kRimWidth_px; dx <= kRimWidth_px; ++dx) most = std::max(most, at(x + dx, y + dy));
      word.rim.push_back(most);
    }
  return word;
}

}  // namespace

const WordPixels& wordPixels(const std::string& text, int line_px) {
  thread_local std::map<std::pair<int, std::string>, WordPixels> words;
  const auto key = std::make_pair(line_px, text);
  const auto found = words.find(key);
  if (found != words.end()) return found->second;
  if (words.size() >= kMostWords) words.clear();
  return words.emplace(key, drawnWord(text, line_px)).first->second;
}

}  // namespace render
