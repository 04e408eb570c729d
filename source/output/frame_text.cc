// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/output/frame_text.h>
#include <caisson_mpm/output/point_quantities.h>
#include <caisson_mpm/output/vtu_piece.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <utility>
#include <vector>

namespace CaissonMPM
{
  using namespace dealii;

  namespace
  {
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

    /**
     * The void ratio of points, or unknown; of the soil itself, without the gap
     * of a point that has been torn apart. Points that the wall and the tip
     * drag along have volumes that mean nothing, though they are a negligible
     * part of the soil: e would be below 0, or so high that the grains could
     * not touch. Soil without pores at the start has no void ratio.
     */
    class VoidRatio
    {
    public:
      VoidRatio(const Soil &soil)
        : materials(soil.kernel_materials())
      {}

      double
      operator()(const MaterialPoint &p) const
      {
        constexpr double         largest_volume_ratio = 2.;
        const Kernels::Material &material             = materials[p.material];
        const double             initial = material.initial_void_ratio,
                     now                 = p.void_ratio(initial);
        const bool is_known =
          initial > 0. && now >= 0. &&
          p.volume <= largest_volume_ratio * p.initial_volume;
        return is_known ? void_ratio_of_soil(material, p.stress, now) : unknown;
      }

    private:
      std::vector<Kernels::Material> materials;
    };

    /** The yield stress of points (Pa), unknown where their law has none. */
    class YieldStress
    {
    public:
      YieldStress(const std::vector<Kernels::Material> &materials)
        : materials(materials)
      {}

      double
      operator()(const MaterialPoint &p) const
      {
        const Kernels::Material &material = materials[p.material];
        return has_yield_stress(material) ?
                 yield_stress_of(material,
                                 p.stress,
                                 p.void_ratio(material.initial_void_ratio),
                                 p.state) :
                 unknown;
      }

    private:
      std::vector<Kernels::Material> materials;
    };

    bool
    is_pore_pressure(const PointField &field)
    {
      return field.name() == "pore_pressure";
    }

    /** Where a component of a vector or of a symmetric tensor is in an array,
     * and the number of values there, in the order of VTK: x is r, y is z, and
     * the direction around the axis is the third. */
    struct Slot
    {
      unsigned int place, n_components;
    };

    Slot
    slot_of(const std::string &component)
    {
      static const std::map<std::string, Slot> slots = {{"r", {0, 3}},
                                                        {"z", {1, 3}},
                                                        {"rr", {0, 6}},
                                                        {"zz", {1, 6}},
                                                        {"tt", {2, 6}},
                                                        {"rz", {3, 6}}};
      const auto                               found = slots.find(component);
      return found == slots.end() ? Slot{0, 1} : found->second;
    }

    using Values = std::function<double(const MaterialPoint &)>;

    /** An array that is written, and how its components follow from a point. */
    struct FrameField
    {
      std::string                                  name;
      unsigned int                                 n_components = 1;
      std::vector<std::pair<unsigned int, Values>> parts        = {};
    };

    /** The quantities of points that @p is_written chooses. */
    std::vector<FrameField>
    fields_of(const std::function<bool(const PointField &)> &is_written)
    {
      std::vector<FrameField> fields;
      for (const NamedQuantity &quantity : all_point_quantities())
        {
          const PointField &about = quantity.about;
          if (!is_written(about) || about.name() == "id")
            continue;
          const Slot        slot = slot_of(about.component);
          const std::string name =
            with_unit(slot.n_components > 1 ? about.owner : about.name(),
                      about.unit);
          if (fields.empty() || fields.back().name != name)
            fields.push_back({name, slot.n_components});
          fields.back().parts.emplace_back(slot.place, quantity.value);
        }
      return fields;
    }

    /** The vertical effective stress, positive in compression, in kPa. */
    double
    vertical_stress(const MaterialPoint &p)
    {
      return -p.stress[zz] / 1000.;
    }

    /** The same before anything happens, at the present place of the point;
     * unknown above the ground. */
    Values
    vertical_stress_at_rest(const Soil &soil)
    {
      return [&soil](const MaterialPoint &p) {
        const double at_rest = p.position[vertical] < 0. ?
                                 -soil.initial_stress(p.position)[zz] / 1000. :
                                 0.;
        return at_rest > 0. ? at_rest : unknown;
      };
    }

    /** The number of the layer, from 1. */
    Values
    layer(const Soil &soil)
    {
      return [&soil](const MaterialPoint &p) {
        return soil.material(p.material).layer + 1.;
      };
    }

    const char *const name_of_vertical_stress = "vertical_effective_stress_kPa",
                      *const name_of_ratio =
                        "vertical_stress_over_stress_at_rest";

    /** What the laws keep of a point: the yield stress, and STATEV of user
     * materials, where there are any. */
    std::vector<FrameField>
    fields_of_laws(const Soil &soil)
    {
      std::vector<FrameField> fields;
      const auto              materials = soil.kernel_materials();
      if (std::any_of(materials.begin(), materials.end(), has_yield_stress))
        fields.push_back({"yield_stress_Pa", 1, {{0, YieldStress(materials)}}});
      const unsigned int n_state = soil.n_user_state(),
                         first   = Kernels::UserState::variables;
      for (unsigned int i = first; i < n_state; ++i)
        fields.push_back({"statev_" + to_text(i - first + 1),
                          1,
                          {{0, PointQuantity::state_variable(i - first)}}});
      return fields;
    }

    /** The values of a point that are written, but for its number. */
    std::vector<FrameField>
    fields_of_points(const Soil  &soil,
                     const double circumference,
                     const bool   with_pore_pressure)
    {
      auto         fields  = fields_of([&](const PointField &field) {
        return field.in_frames == InFrames::drawn ||
               (with_pore_pressure && is_pore_pressure(field));
      });
      const Values at_rest = vertical_stress_at_rest(soil);
      const std::pair<std::string, Values> more[] = {
        {"void_ratio", VoidRatio(soil)},
        {"whole_volume_m3",
         [=](const MaterialPoint &p) { return circumference * p.volume; }},
        {name_of_vertical_stress, vertical_stress},
        {name_of_ratio,
         [=](const MaterialPoint &p) {
           return vertical_stress(p) / at_rest(p);
         }},
        {"layer", layer(soil)}};
      for (const auto &[name, value] : more)
        fields.push_back({name, 1, {{0, value}}});
      const auto of_laws = fields_of_laws(soil);
      fields.insert(fields.end(), of_laws.begin(), of_laws.end());
      return fields;
    }

    /** A mean over the points of each cell, by volume. */
    class CellMean
    {
    public:
      CellMean(const Values &quantity, const unsigned int n_cells)
        : quantity(quantity)
        , sum(n_cells)
        , volume(n_cells)
      {}

      /** Add a point, unless it does not know the quantity. */
      void
      add(const MaterialPoint &p, const unsigned int cell)
      {
        const double value = quantity(p);
        if (std::isnan(value))
          return;
        sum[cell] += p.volume * value;
        volume[cell] += p.volume;
      }

      double
      operator[](const unsigned int cell) const
      {
        return volume[cell] > 0. ? sum[cell] / volume[cell] : unknown;
      }

    private:
      Values              quantity;
      std::vector<double> sum, volume;
    };

    /** The cells of this rank with their data; the vertices must have been
     * written. */
    class CellFields
    {
    public:
      CellFields(const BackgroundGrid &grid,
                 const Soil           &soil,
                 const bool            with_pore_pressure)
        : grid(grid)
        , fields(fields_of([&](const PointField &field) {
          return std::string(field.owner) == "stress" ||
                 (with_pore_pressure && is_pore_pressure(field));
        }))
        , n_points(grid.n_cells(), 0)
        , at_rest(vertical_stress_at_rest(soil), grid.n_cells())
        , layers(layer(soil), grid.n_cells())
      {
        fields.push_back({"void_ratio", 1, {{0, VoidRatio(soil)}}});
        fields.push_back({name_of_vertical_stress, 1, {{0, vertical_stress}}});
        for (const FrameField &field : fields)
          for (const auto &part : field.parts)
            means.emplace_back(part.second, grid.n_cells());
      }

      void
      add(const MaterialPoints &points)
      {
        points.for_each([&](const MaterialPoint &p, const unsigned int cell) {
          ++n_points[cell];
          for (CellMean &mean : means)
            mean.add(p, cell);
          at_rest.add(p, cell);
          layers.add(p, cell);
        });
      }

      VtuPiece
      piece() const
      {
        VtuPiece result;
        add_cells(result);
        add_arrays(result);
        return result;
      }

    private:
      void
      add_cells(VtuPiece &piece) const
      {
        std::map<unsigned int, unsigned int> numbers; // of the vertices
        for (unsigned int cell = 0; cell < grid.n_cells(); ++cell)
          {
            if (!grid.is_owned(cell))
              continue;
            const auto               &iterator = grid.cell_iterator(cell);
            std::vector<unsigned int> corners;
            for (unsigned int i = 0; i < 4; ++i)
              {
                const auto found = numbers.find(iterator->vertex_index(i));
                corners.push_back(found != numbers.end() ?
                                    found->second :
                                    piece.add_point(iterator->vertex(i)));
                numbers[iterator->vertex_index(i)] = corners.back();
              }
            piece.add_cell(corners);
          }
      }

      void
      add_arrays(VtuPiece &piece) const
      {
        const auto add = [&](const std::string &name, const auto &value) {
          piece.of_cells.push_back({name, 1, {}});
          for (unsigned int cell = 0; cell < grid.n_cells(); ++cell)
            if (grid.is_owned(cell))
              piece.of_cells.back().values.push_back(value(cell));
        };
        add("material_id", [&](const unsigned int cell) {
          return grid.is_rigid(cell) ? 1. : 0.;
        });
        add("zone", [&](const unsigned int cell) {
          return static_cast<unsigned int>(grid.zone(cell));
        });
        add("material_points",
            [&](const unsigned int cell) { return n_points[cell]; });
        add_means(piece);
        const CellMean &stress = means.back();
        add(name_of_ratio, [&](const unsigned int cell) {
          return stress[cell] / at_rest[cell];
        });
        add("layer",
            [&](const unsigned int cell) { return std::round(layers[cell]); });
      }

      void
      add_means(VtuPiece &piece) const
      {
        auto mean = means.begin();
        for (const FrameField &field : fields)
          {
            const unsigned int n = field.n_components;
            piece.of_cells.push_back(
              {field.name, n, std::vector<float>(n * piece.n_cells(), 0.f)});
            for (const auto &part : field.parts)
              {
                float *value = &piece.of_cells.back().values[part.first];
                for (unsigned int cell = 0; cell < grid.n_cells(); ++cell)
                  if (grid.is_owned(cell))
                    {
                      *value = (*mean)[cell];
                      value += n;
                    }
                ++mean;
              }
          }
      }

      const BackgroundGrid     &grid;
      std::vector<FrameField>   fields;
      std::vector<CellMean>     means; // of the parts of the fields
      std::vector<unsigned int> n_points;
      CellMean                  at_rest, layers;
    };

    /** The section of the body: the cells of the mesh in it, which follow its
     * surface exactly. All ranks know the lines of the whole mesh, and thus all
     * of the body. */
    VtuPiece
    section_of(const GridLines &lines, const RigidBody &body)
    {
      const double travel = body.motion().travel();
      VtuPiece     piece;
      for (unsigned int i = 0; i < lines.n_cells(); ++i)
        {
          if (!lines.is_body_cell(GlobalCell(i)))
            continue;
          const CellBlock           cell = lines.tree().block(GlobalCell(i));
          std::vector<unsigned int> corners;
          for (unsigned int corner = 0; corner < 4; ++corner)
            {
              const unsigned int column = cell.column + corner % 2 * cell.size,
                                 row    = cell.row + corner / 2 * cell.size;
              corners.push_back(
                piece.add_point(lines.node_start(column, row) +
                                travel * lines.node_rate(column, row)));
            }
          piece.add_cell(corners);
        }
      piece.of_cells.push_back(
        {"penetration_m",
         1,
         std::vector<float>(piece.n_cells(), body.penetration())});
      return piece;
    }
  } // namespace

  std::string
  FrameText::of_points(const unsigned long long begin,
                       const unsigned long long end) const
  {
    const auto fields =
      fields_of_points(soil, grid.circumference(), with_pore_pressure);
    VtuPiece piece;
    for (const FrameField &field : fields)
      piece.of_points.push_back({field.name, field.n_components, {}});
    unsigned long long i = 0;
    points.for_each([&](const MaterialPoint &p, const unsigned int) {
      if (i >= begin && i < end)
        {
          piece.add_cell({piece.add_point(p.position)});
          // halves of a point share its number
          piece.ids.push_back(static_cast<std::int64_t>(p.id));
          for (std::size_t k = 0; k < fields.size(); ++k)
            {
              auto      &values = piece.of_points[k].values;
              const auto start  = values.size();
              values.resize(start + fields[k].n_components, 0.f);
              for (const auto &[place, value] : fields[k].parts)
                values[start + place] = value(p);
            }
        }
      ++i;
    });
    return piece.text(time);
  }

  std::string
  FrameText::of_cells() const
  {
    CellFields cells(grid, soil, with_pore_pressure);
    cells.add(points);
    return cells.piece().text(time);
  }

  std::string
  FrameText::of_body(const RigidBody &body) const
  {
    const VtuPiece section = section_of(grid.lines(), body);
    return section.n_cells() == 0 ? "" : section.text(time);
  }
} // namespace CaissonMPM
