// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/kernels/layout.h>
#include <caisson_mpm/output/frame_data.h>
#include <caisson_mpm/output/point_quantities.h>

#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <utility>

namespace CaissonMPM
{
  using namespace dealii;

  namespace
  {
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

    using Quantity = std::function<double(const MaterialPoint &)>;

    /**
     * The void ratio of points, or unknown; of the soil itself, without the gap
     * of a point that has been torn apart. Points that the wall and the tip
     * drag along have volumes that mean nothing, though they are a negligible
     * part of the soil: e would be below 0, or so high that the grains could
     * not touch. Soil without pores at the start has no void ratio.
     */
    Quantity
    void_ratio(const Soil &soil)
    {
      return [materials = soil.kernel_materials()](const MaterialPoint &p) {
        constexpr double         largest_volume_ratio = 2.;
        const Kernels::Material &material             = materials[p.material];
        const double             initial = material.initial_void_ratio,
                     now                 = p.void_ratio(initial);
        const bool is_known =
          initial > 0. && now >= 0. &&
          p.volume <= largest_volume_ratio * p.initial_volume;
        return is_known ? void_ratio_of_soil(material, p.stress, now) : unknown;
      };
    }

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

    /** An array that is written, and how its components follow from a point. */
    struct FrameField
    {
      std::string                                    name;
      unsigned int                                   n_components = 1;
      std::vector<std::pair<unsigned int, Quantity>> parts        = {};
    };

    /** The same of the point as files show it, with its pore pressure as a part
     * of its stress in materials of @p total. [n_materials] */
    Quantity
    as_shown(const Quantity &quantity, const std::vector<bool> &total)
    {
      return [=](const MaterialPoint &p) {
        return quantity(total[p.material] ? p.with_pressure_in_stress() : p);
      };
    }

    /** The quantities of points that @p is_written chooses. */
    std::vector<FrameField>
    fields_of(const std::vector<bool>                       &total,
              const std::function<bool(const PointField &)> &is_written)
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
          fields.back().parts.emplace_back(slot.place,
                                           as_shown(quantity.value, total));
        }
      return fields;
    }

    /** The vertical effective stress, positive in compression, in kPa. */
    Quantity
    vertical_stress(const std::vector<bool> &total)
    {
      return as_shown(
        [](const MaterialPoint &p) { return -p.stress[zz] / 1000.; }, total);
    }

    /** The same before anything happens, at the present place of the point;
     * unknown above the ground. */
    Quantity
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
    Quantity
    layer(const Soil &soil)
    {
      return [&soil](const MaterialPoint &p) {
        return soil.material(p.material).layer + 1.;
      };
    }

    const char *const name_of_vertical_stress = "vertical_effective_stress_kPa",
                      *const name_of_ratio =
                        "vertical_stress_over_stress_at_rest";

    /** What the laws keep of a point: STATEV of user materials, if any. */
    std::vector<FrameField>
    fields_of_laws(const Soil &soil)
    {
      std::vector<FrameField> fields;
      const unsigned int      n_state = soil.n_user_state(),
                         first        = Kernels::UserState::variables;
      for (unsigned int i = first; i < n_state; ++i)
        fields.push_back({"statev_" + to_text(i - first + 1),
                          1,
                          {{0, PointQuantity::state_variable(i - first)}}});
      return fields;
    }

    /** The values of a point that are written, but for its number. */
    std::vector<FrameField>
    fields_of_points(const Soil              &soil,
                     const double             circumference,
                     const std::vector<bool> &total,
                     const bool               with_pore_pressure)
    {
      auto           fields  = fields_of(total, [&](const PointField &field) {
        return field.in_frames == InFrames::drawn ||
               (with_pore_pressure && is_pore_pressure(field));
      });
      const Quantity at_rest = vertical_stress_at_rest(soil),
                     now     = vertical_stress(total);
      const std::pair<std::string, Quantity> more[] = {
        {"void_ratio", void_ratio(soil)},
        {"whole_volume_m3",
         [=](const MaterialPoint &p) { return circumference * p.volume; }},
        {name_of_vertical_stress, now},
        {name_of_ratio,
         [=](const MaterialPoint &p) { return now(p) / at_rest(p); }},
        {"layer", layer(soil)}};
      for (const auto &[name, value] : more)
        fields.push_back({name, 1, {{0, value}}});
      const auto of_laws = fields_of_laws(soil);
      fields.insert(fields.end(), of_laws.begin(), of_laws.end());
      return fields;
    }

    /** The means of a quantity over the points of each cell that know it, by
     * volume. [n_cells] */
    std::vector<double>
    means_in_cells(const MaterialPoints &points,
                   const unsigned int    n_cells,
                   const Quantity       &quantity)
    {
      std::vector<double> mean(n_cells, 0.), volume(n_cells, 0.);
      points.for_each([&](const MaterialPoint &p, const unsigned int cell) {
        const double value = quantity(p);
        if (std::isnan(value))
          return;
        mean[cell] += p.volume * value;
        volume[cell] += p.volume;
      });
      for (unsigned int cell = 0; cell < n_cells; ++cell)
        mean[cell] = volume[cell] > 0. ? mean[cell] / volume[cell] : unknown;
      return mean;
    }

    /** The cells of this rank, without data. */
    VtuPiece
    mesh_of(const BackgroundGrid &grid)
    {
      VtuPiece                             piece;
      std::map<unsigned int, unsigned int> numbers; // of the vertices
      for (unsigned int cell = 0; cell < grid.n_cells(); ++cell)
        if (grid.is_owned(cell))
          {
            const auto               &iterator = grid.cell_iterator(cell);
            std::vector<unsigned int> corners;
            for (unsigned int i = 0; i < 4; ++i)
              {
                const auto [found, is_new] =
                  numbers.try_emplace(iterator->vertex_index(i));
                if (is_new)
                  found->second = piece.add_point(iterator->vertex(i));
                corners.push_back(found->second);
              }
            piece.add_cell(corners);
          }
      return piece;
    }
  } // namespace

  VtuPiece
  FrameData::of_points(const unsigned long long begin,
                       const unsigned long long end) const
  {
    const auto fields =
      fields_of_points(soil, grid.circumference(), total, with_pore_pressure);
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
    return piece;
  }

  VtuPiece
  FrameData::of_cells() const
  {
    VtuPiece   piece     = mesh_of(grid);
    const auto add_array = [&](const std::string &name, const unsigned int n) {
      piece.of_cells.push_back(
        {name, n, std::vector<float>(n * piece.n_cells(), 0.f)});
    };
    // one component of the last array
    const auto fill = [&](const auto &value, const unsigned int place = 0) {
      auto        &array = piece.of_cells.back();
      unsigned int i     = place;
      for (unsigned int cell = 0; cell < grid.n_cells(); ++cell)
        if (grid.is_owned(cell))
          {
            array.values[i] = value(cell);
            i += array.n_components;
          }
    };
    const auto means = [&](const Quantity &quantity) {
      return [mean = means_in_cells(points, grid.n_cells(), quantity)](
               const unsigned int cell) { return mean[cell]; };
    };

    add_array("material_id", 1);
    fill([&](const unsigned int cell) { return grid.is_rigid(cell); });
    add_array("zone", 1);
    fill([&](const unsigned int cell) {
      return static_cast<unsigned int>(grid.zone(cell));
    });
    std::vector<unsigned int> n_points(grid.n_cells(), 0);
    points.for_each([&](const MaterialPoint &, const unsigned int cell) {
      ++n_points[cell];
    });
    add_array("material_points", 1);
    fill([&](const unsigned int cell) { return n_points[cell]; });

    auto           fields   = fields_of(total, [&](const PointField &field) {
      return std::string(field.owner) == "stress" ||
             (with_pore_pressure && is_pore_pressure(field));
    });
    const Quantity vertical = vertical_stress(total);
    fields.push_back({"void_ratio", 1, {{0, void_ratio(soil)}}});
    fields.push_back({name_of_vertical_stress, 1, {{0, vertical}}});
    for (const FrameField &field : fields)
      {
        add_array(field.name, field.n_components);
        for (const auto &[place, value] : field.parts)
          fill(means(value), place);
      }
    add_array(name_of_ratio, 1);
    const auto now     = means(vertical),
               at_rest = means(vertical_stress_at_rest(soil));
    fill([&](const unsigned int cell) { return now(cell) / at_rest(cell); });
    add_array("layer", 1);
    fill([mean = means(layer(soil))](const unsigned int cell) {
      return std::round(mean(cell));
    });
    return piece;
  }

  VtuPiece
  FrameData::of_body(const RigidBody &body) const
  {
    const GridLines &lines  = grid.lines();
    const double     travel = body.motion().travel();
    VtuPiece         piece;
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
} // namespace CaissonMPM
