// SPDX-License-Identifier: MIT
#include "demo/shadow_contour.h"

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <unordered_map>
#include <utility>

#include "demo/map_places.h"

namespace demo {
namespace {

constexpr float kHalf = 0.5F;

/// On one surface a step from pixel to pixel is like the step before it or after it; chosen so that
/// spheres keep their pixels almost to the rim.
constexpr float kMostChangeOfStep = 0.5F;

/// Which neighbours lie on one surface.
class Surfaces {
  public:
    explicit Surfaces(const renderer::FloatImage& places) : places_(places) {}

    bool joined(int x, int y, int dx, int dy) const {
        const auto step = between(x, y, dx, dy);
        if (!step) return false;
        const auto alike = [&](const std::optional<glm::vec3>& other) {
            return other && glm::length(*step - *other) <= kMostChangeOfStep * glm::length(*other);
        };
        return alike(between(x - dx, y - dy, dx, dy)) || alike(between(x + dx, y + dy, dx, dy));
    }

  private:
    std::optional<glm::vec3> between(int x, int y, int dx, int dy) const {
        const auto from = at(x, y);
        const auto to = at(x + dx, y + dy);
        if (!from || !to) return std::nullopt;
        return *to - *from;
    }
    std::optional<glm::vec3> at(int x, int y) const {
        if (x < 0 || y < 0 || x >= places_.width || y >= places_.height) return std::nullopt;
        if (places_.at(x, y, kPlaceIsSurface) == 0) return std::nullopt;
        return glm::vec3(places_.at(x, y, kPlaceU), places_.at(x, y, kPlaceV),
                         places_.at(x, y, kPlaceDepth));
    }

    const renderer::FloatImage& places_;
};

/// Crossings of the half-way line with the edges between pixels, each linked to up to two others.
struct Crossing {
    ContourPoint point;
    std::array<std::size_t, 2> linked{};
    std::size_t links = 0;
};
// Edges are numbered: twice the pixel's number, one more for the edge that goes down.
using Crossings = std::unordered_map<std::size_t, Crossing>;

class Tracer {
  public:
    Tracer(const renderer::FloatImage& visibility, const renderer::FloatImage& places)
        : visibility_(visibility), surfaces_(places) {
        for (int y = 0; y + 1 < visibility.height; ++y)
            for (int x = 0; x + 1 < visibility.width; ++x) addCell(x, y);
    }

    std::vector<Contour> contours() {
        std::vector<Contour> all;
        std::unordered_map<std::size_t, bool> done;
        const auto follow = [&](std::size_t start) {
            Contour contour;
            std::size_t before = start;
            for (std::size_t at = start; !done[at];) {
                done[at] = true;
                const Crossing& crossing = crossings_.at(at);
                contour.points.push_back(crossing.point);
                std::size_t next = at;
                for (std::size_t i = 0; i < crossing.links; ++i)
                    if (crossing.linked[i] != before && !done[crossing.linked[i]])
                        next = crossing.linked[i];
                before = at;
                at = next;
            }
            // Open lines are begun at their ends, so whoever has two neighbours is on a closed one.
            contour.closed = crossings_.at(start).links == 2;
            all.push_back(std::move(contour));
        };
        for (const std::size_t edge : order_)
            if (crossings_.at(edge).links == 1 && !done[edge]) follow(edge);
        for (const std::size_t edge : order_)
            if (!done[edge]) follow(edge);
        return all;
    }

  private:
    float value(int x, int y) const { return visibility_.at(x, y); }
    bool lit(int x, int y) const { return value(x, y) >= kHalf; }

    void addCell(int x, int y) {
        const int corners = lit(x, y) + lit(x + 1, y) + lit(x, y + 1) + lit(x + 1, y + 1);
        if (corners == 0 || corners == 4) return;
        if (!surfaces_.joined(x, y, 1, 0) || !surfaces_.joined(x, y + 1, 1, 0) ||
            !surfaces_.joined(x, y, 0, 1) || !surfaces_.joined(x + 1, y, 0, 1))
            return;
        // Around the cell: top, right, bottom, left.
        const std::array<std::optional<std::size_t>, 4> edges = {
            crossing(x, y, 1, 0), crossing(x + 1, y, 0, 1), crossing(x, y + 1, 1, 0),
            crossing(x, y, 0, 1)};
        std::vector<std::size_t> crossed;
        for (const auto& edge : edges)
            if (edge) crossed.push_back(*edge);
        if (crossed.size() == 2) {
            link(crossed[0], crossed[1]);
        } else if (crossed.size() == 4) {
            // A saddle: the middle's side is the one that goes through.
            const float middle =
                0.25F * (value(x, y) + value(x + 1, y) + value(x, y + 1) + value(x + 1, y + 1));
            const bool cutOffFirst = (middle >= kHalf) != lit(x, y);
            link(crossed[0], crossed[cutOffFirst ? 3 : 1]);
            link(crossed[2], crossed[cutOffFirst ? 1 : 3]);
        }
    }

    std::optional<std::size_t> crossing(int x, int y, int dx, int dy) {
        if (lit(x, y) == lit(x + dx, y + dy)) return std::nullopt;
        const std::size_t first = visibility_.index(x, y);
        const std::size_t edge = 2 * first + (dy == 1 ? 1 : 0);
        if (!crossings_.contains(edge)) {
            const float from = value(x, y);
            const float share = (kHalf - from) / (value(x + dx, y + dy) - from);
            crossings_[edge].point = {first, visibility_.index(x + dx, y + dy), share};
            order_.push_back(edge);
        }
        return edge;
    }

    void link(std::size_t a, std::size_t b) {
        for (const auto& [one, other] : {std::pair{a, b}, std::pair{b, a}}) {
            Crossing& crossing = crossings_.at(one);
            crossing.linked.at(crossing.links++) = other;
        }
    }

    const renderer::FloatImage& visibility_;
    Surfaces surfaces_;
    Crossings crossings_;
    std::vector<std::size_t> order_;  // as found: the same lines in the same order every time
};

}  // namespace

double valueAt(const renderer::FloatImage& image, const ContourPoint& point, int channel) {
    const auto at = [&](std::size_t pixel) {
        return static_cast<double>(image.values[pixel * static_cast<std::size_t>(image.channels) +
                                                static_cast<std::size_t>(channel)]);
    };
    const auto share = static_cast<double>(point.share);
    return (1 - share) * at(point.first) + share * at(point.second);
}

std::vector<Contour> shadowContours(const renderer::FloatImage& visibility,
                                    const renderer::FloatImage& places) {
    if (visibility.width != places.width || visibility.height != places.height ||
        places.channels != 4)
        throw std::invalid_argument(
            "shadow contours: visibility is " + std::to_string(visibility.width) + " x " +
            std::to_string(visibility.height) + ", places " + std::to_string(places.width) + " x " +
            std::to_string(places.height) + " of " + std::to_string(places.channels) +
            " channels; they must be of one size, places of 4 channels");
    return Tracer(visibility, places).contours();
}

}  // namespace demo
