#pragma once
/// The left half of the head on one grid of columns (azimuth) and rows (elevation), slit at eye and mouth, relaxed once
/// and laid flat; heads of every tessellation are samples of it.

#include <vector>

#include "tools/make_face/mesh.h"

namespace blush::make_face {

/// Lines of the grid: azimuths from the front to the back, elevations from the cut through the bust to the crown.
struct Grid {
    std::vector<double> azimuths, elevations;
    int mouth_corner = 0, inner_canthus = 0, outer_canthus = 0;  ///< columns
    int chin = 0, mouth = 0, eye = 0, brow = 0;                  ///< rows
    int last_column() const { return static_cast<int>(azimuths.size()) - 1; }
    int last_row() const { return static_cast<int>(elevations.size()) - 1; }
    bool in_mouth(int i) const { return i < mouth_corner; }
    bool in_eye(int i) const { return i > inner_canthus && i < outer_canthus; }
    bool slit(int i, int j) const { return (j == mouth && in_mouth(i)) || (j == eye && in_eye(i)); }
};
/// `fineness` 1 has some 10,000 nodes; the number of lines between two features is in proportion to it.
Grid make_grid(double fineness);

class CoarseHead {
public:
    CoarseHead();

    const Grid& grid() const { return grid_; }

    struct Sample {
        Vec3 position;
        Vec2 flat;  ///< in the chart, millimetres: x = 0 in the middle, y up
    };
    /// Cubic between the nodes, `above` or below the slit where `row` is a slit's; off the surface by what a cubic
    /// misses.
    Sample at(double column, double row, bool above) const;

private:
    Index id(int i, int j) const;
    Index upper_id(int i, int j) const;
    void number_vertices();
    template <class Height>
    Vec3 on_curve(int i, double elevation, Height y) const;
    Vec3 below_chin(int i, double share) const;
    void place_fan();
    void pin(int i, int j, const Vec3& low, const Vec3& up);
    void relax();
    void lay_flat();

    Grid grid_;
    std::size_t columns_ = 0;
    std::vector<Index> lower_, upper_;
    std::vector<Vec3> positions_;
    std::vector<Vec2> flat_;
    std::vector<char> pinned_;
};

}  // namespace blush::make_face
