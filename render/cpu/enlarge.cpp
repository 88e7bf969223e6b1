#include "render/cpu/enlarge.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace render {
namespace {

// Steps of brightness from pixel to pixel: below the first there is no edge, above the second nothing else.
constexpr float kNoEdge = 0.02f, kEdge = 0.06f;
// Reach of the kernel in pixels of the small image.
constexpr float kAlong = 2.6f, kAcross = 0.95f;
constexpr int kTaps = 6;

// Where a pixel of the large image lies in the small one, along one axis.
struct Place {
  int low, high;   // clamped neighbours
  int first;       // the neighbour before, not clamped
  float part, at;  // between them; from the first pixel's centre
};

std::vector<Place> placesAlong(int small, int large) {
  std::vector<Place> places(static_cast<std::size_t>(large));
  for (int n = 0; n < large; ++n) {
    Place& place = places[static_cast<std::size_t>(n)];
    place.at = (static_cast<float>(n) + 0.5f) * static_cast<float>(small) / static_cast<float>(large) - 0.5f;
    place.first = static_cast<int>(std::floor(place.at));
    place.part = place.at - static_cast<float>(place.first);
    place.low = std::clamp(place.first, 0, small - 1);
    place.high = std::clamp(place.first + 1, 0, small - 1);
  }
  return places;
}

// The mean along the edge around a point of the small image.
glm::vec3 alongEdge(const EyeImage& from, const Place& column, const Place& row, const glm::vec2& tangent) {
  glm::vec3 sum(0.0f);
  float weights = 0.0f;
  for (int j = 0; j < kTaps; ++j) {
    const int y = row.first - kTaps / 2 + 1 + j;
    const std::size_t line = from.at(0, std::clamp(y, 0, from.px.y - 1));
    const float dy = static_cast<float>(y) - row.at;
    for (int i = 0; i < kTaps; ++i) {
      const int x = column.first - kTaps / 2 + 1 + i;
      const float dx = static_cast<float>(x) - column.at;
      const float along = (dx * tangent.x + dy * tangent.y) / kAlong,
                  across = (dy * tangent.x - dx * tangent.y) / kAcross;
      const float inside = 1.0f - along * along - across * across;
      if (inside <= 0.0f) continue;
      const float weight = inside * inside;
      const std::size_t n = line + static_cast<std::size_t>(std::clamp(x, 0, from.px.x - 1));
      sum += weight * glm::vec3(from.r[n], from.g[n], from.b[n]);
      weights += weight;
    }
  }
  return sum / weights;  // the nearest pixel is always inside
}

// Unit vector along the edge, from the mean products of the gradient.
glm::vec2 tangentOf(float xx, float xy, float yy) {
  // Twice the angle of the gradient; the edge is across it.
  const float angle = 0.5f * std::atan2(2.0f * xy, xx - yy);
  return {-std::sin(angle), std::cos(angle)};
}

float smoothStep(float low, float high, float value) {
  const float t = std::clamp((value - low) / (high - low), 0.0f, 1.0f);
  return t * t * (3.0f - 2.0f * t);
}

}  // namespace

void Enlarger::findEdges(const EyeImage& from) {
  const int w = from.px.x, h = from.px.y;
  const auto count = static_cast<std::size_t>(w) * static_cast<std::size_t>(h);
  brightness_.resize(count);
  edge_.resize(count);
  sharp_.resize(count);
  tensor_.resize(count);
  tbb::parallel_for(0, h, [&](int y) {
    for (std::size_t n = from.at(0, y); n < from.at(0, y + 1); ++n)
      brightness_[n] = std::sqrt(std::max(0.0f, 0.2126f * from.r[n] + 0.7152f * from.g[n] + 0.0722f * from.b[n]));
  });
  const auto rows_around = [&](int y) {
    return std::array{from.at(0, std::max(y - 1, 0)), from.at(0, y), from.at(0, std::min(y + 1, h - 1))};
  };
  // Sobel's differences, per pixel.
  tbb::parallel_for(0, h, [&](int y) {
    const auto [above, here, below] = rows_around(y);
    for (int x = 0; x < w; ++x) {
      const auto left = static_cast<std::size_t>(std::max(x - 1, 0)), middle = static_cast<std::size_t>(x),
                 right = static_cast<std::size_t>(std::min(x + 1, w - 1));
      const auto& b = brightness_;
      const float dx = 0.125f * (b[above + right] - b[above + left] + 2.0f * (b[here + right] - b[here + left]) +
                                 b[below + right] - b[below + left]);
      const float dy = 0.125f * (b[below + left] - b[above + left] + 2.0f * (b[below + middle] - b[above + middle]) +
                                 b[below + right] - b[above + right]);
      sharp_.xx[here + middle] = dx * dx, sharp_.xy[here + middle] = dx * dy, sharp_.yy[here + middle] = dy * dy;
    }
  });
  tbb::parallel_for(0, h, [&](int y) {
    const std::array<std::size_t, 3> rows = rows_around(y);
    for (int x = 0; x < w; ++x) {
      const auto left = static_cast<std::size_t>(std::max(x - 1, 0)), middle = static_cast<std::size_t>(x),
                 right = static_cast<std::size_t>(std::min(x + 1, w - 1));
      const auto blurred = [&](const std::vector<float>& p) {
        const auto row = [&](std::size_t at) { return p[at + left] + 2.0f * p[at + middle] + p[at + right]; };
        return 0.0625f * (row(rows[0]) + 2.0f * row(rows[1]) + row(rows[2]));
      };
      const std::size_t n = rows[1] + middle;
      const float xx = tensor_.xx[n] = blurred(sharp_.xx), xy = tensor_.xy[n] = blurred(sharp_.xy),
                  yy = tensor_.yy[n] = blurred(sharp_.yy);
      // Corners and speckles have no direction.
      const float strength = smoothStep(kNoEdge, kEdge, std::sqrt(xx + yy));
      const float one_way = strength > 0.0f ? std::sqrt((xx - yy) * (xx - yy) + 4.0f * xy * xy) / (xx + yy) : 0.0f;
      edge_[n] = strength * one_way;
    }
  });
}

void Enlarger::enlarge(const EyeImage& from, glm::ivec2 px, EyeImage& to, Edges edges) {
  to.resize(px);
  const bool is_smooth = edges == Edges::smooth;
  if (is_smooth) findEdges(from);
  const std::vector<Place> columns = placesAlong(from.px.x, px.x), rows = placesAlong(from.px.y, px.y);
  const auto width = static_cast<std::size_t>(from.px.x);
  tbb::parallel_for(0, px.y, [&](int y) {
    // Down first, over the narrow row.
    thread_local std::vector<float> narrow;
    narrow.resize(7 * width);
    const Place& row = rows[static_cast<std::size_t>(y)];
    const std::size_t low = from.at(0, row.low), high = from.at(0, row.high);
    const std::vector<float>* const planes[] = {&from.r,     &from.g,     &from.b,    &edge_,
                                                &tensor_.xx, &tensor_.xy, &tensor_.yy};
    for (std::size_t plane = 0; plane < (is_smooth ? 7U : 3U); ++plane) {
      const float *const a = planes[plane]->data() + low, *const b = planes[plane]->data() + high;
      float* const mixed = narrow.data() + plane * width;
      for (std::size_t x = 0; x < width; ++x) mixed[x] = a[x] + (b[x] - a[x]) * row.part;
    }
    const std::size_t first = to.at(0, y);
    for (std::size_t x = 0; x < columns.size(); ++x) {
      const Place& column = columns[x];
      const auto mixed = [&](std::size_t plane) {
        const float* const of = narrow.data() + plane * width;
        return of[column.low] + (of[column.high] - of[column.low]) * column.part;
      };
      glm::vec3 light(mixed(0), mixed(1), mixed(2));
      if (const float edge = is_smooth ? mixed(3) : 0.0f; edge > 0.0f)
        light = glm::mix(light, alongEdge(from, column, row, tangentOf(mixed(4), mixed(5), mixed(6))), edge);
      to.r[first + x] = light.r, to.g[first + x] = light.g, to.b[first + x] = light.b;
    }
  });
}

}  // namespace render
