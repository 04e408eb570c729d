// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/output/frame_text.h>
#include <caisson_mpm/output/point_quantities.h>
#include <caisson_mpm/output/vtu_file.h>

#include <deal.II/numerics/data_out.h>

#include <deal.II/particles/data_out.h>
#include <deal.II/particles/particle_handler.h>

#include <cmath>
#include <functional>
#include <limits>

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

    bool
    is_pore_pressure(const PointField &field)
    {
      return field.name() == "pore_pressure";
    }

    /** The values of a point that are written: the quantities that are drawn,
     * and some that the scene decides. */
    class WrittenFields
    {
    public:
      WrittenFields(const Soil  &soil,
                    const double circumference,
                    const bool   with_pore_pressure)
        : void_ratio(soil)
        , circumference(circumference)
      {
        for (const NamedQuantity &quantity : all_point_quantities())
          if (quantity.about.in_frames == InFrames::drawn ||
              (with_pore_pressure && is_pore_pressure(quantity.about)))
            {
              quantities.push_back(quantity.value);
              add_name(quantity.about);
            }
        names.insert(names.end(), {"void_ratio", "whole_volume_m3"});
        interpretation.resize(names.size(),
                              Interpretation::component_is_scalar);
      }

      std::vector<double>
      of(const MaterialPoint &p) const
      {
        std::vector<double> values;
        for (const PointQuantity &quantity : quantities)
          values.push_back(quantity(p));
        values.push_back(void_ratio(p));
        values.push_back(circumference * p.volume);
        return values;
      }

      using Interpretation =
        DataComponentInterpretation::DataComponentInterpretation;
      std::vector<std::string>    names;
      std::vector<Interpretation> interpretation;

    private:
      /** The components r and z of a vector share its name. */
      void
      add_name(const PointField &field)
      {
        const std::string component = field.component;
        const bool        of_vector = component == "r" || component == "z";
        names.push_back(
          with_unit(of_vector ? field.owner : field.name(), field.unit));
        interpretation.push_back(of_vector ?
                                   Interpretation::component_is_part_of_vector :
                                   Interpretation::component_is_scalar);
      }

      const VoidRatio            void_ratio;
      const double               circumference;
      std::vector<PointQuantity> quantities;
    };

    /** A particle handler with everything that is to be written. */
    class PointCloud
    {
    public:
      PointCloud(const BackgroundGrid &grid, const WrittenFields &fields)
        : grid(grid)
        , fields(fields)
        , handler(grid.triangulation(), grid.mapping(), fields.names.size())
      {}

      /** Add the points of this rank from number begin to end. */
      void
      add(const MaterialPoints    &points,
          const unsigned long long begin,
          const unsigned long long end)
      {
        unsigned long long i = 0;
        points.for_each([&](const MaterialPoint &p, const unsigned int cell) {
          if (i >= begin && i < end)
            add(p, cell);
          ++i;
        });
      }

      Particles::DataOut<2>
      build()
      {
        handler.update_cached_numbers();
        Particles::DataOut<2> data_out;
        data_out.build_patches(handler, fields.names, fields.interpretation);
        return data_out;
      }

    private:
      void
      add(const MaterialPoint &p, const unsigned int cell)
      {
        const std::vector<double> values = fields.of(p);
        // the place in the reference cell is not written; the number is, and
        // halves of a point share it
        handler.insert_particle(p.position,
                                Point<2>(),
                                static_cast<types::particle_index>(p.id),
                                grid.cell_iterator(cell),
                                ArrayView<const double>(values.data(),
                                                        values.size()));
      }

      const BackgroundGrid         &grid;
      const WrittenFields          &fields;
      Particles::ParticleHandler<2> handler;
    };

    /** A mean over the points of each cell, by volume. */
    class CellMean
    {
    public:
      using Quantity = std::function<double(const MaterialPoint &)>;

      CellMean(const std::string &name,
               const Quantity    &quantity,
               const unsigned int n_cells)
        : name(name)
        , quantity(quantity)
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

      Vector<double>
      values() const
      {
        Vector<double> result(sum.size());
        for (unsigned int cell = 0; cell < sum.size(); ++cell)
          result[cell] = volume[cell] > 0. ? sum[cell] / volume[cell] : unknown;
        return result;
      }

      const std::string name;

    private:
      const Quantity quantity;
      Vector<double> sum, volume;
    };

    /** The cells with their data; the vertices must have been written. */
    class CellFields
    {
    public:
      CellFields(const BackgroundGrid &grid,
                 const Soil           &soil,
                 const bool            with_pore_pressure)
        : grid(grid)
        , n_cells(grid.triangulation().n_active_cells())
        , material_id(n_cells)
        , zone(n_cells)
        , material_points(n_cells)
      {
        for (unsigned int cell = 0; cell < grid.n_cells(); ++cell)
          {
            const auto i   = index(cell);
            material_id[i] = grid.is_rigid(cell) ? 1. : 0.;
            zone[i]        = static_cast<unsigned int>(grid.zone(cell));
          }
        for (const NamedQuantity &quantity : all_point_quantities())
          if (std::string(quantity.about.owner) == "stress" ||
              (with_pore_pressure && is_pore_pressure(quantity.about)))
            means.emplace_back(with_unit(quantity.about.name(),
                                         quantity.about.unit),
                               quantity.value,
                               n_cells);
        means.emplace_back("void_ratio", VoidRatio(soil), n_cells);
      }

      void
      add(const MaterialPoints &points)
      {
        points.for_each([&](const MaterialPoint &p, const unsigned int cell) {
          const unsigned int i = index(cell);
          material_points[i] += 1.;
          for (CellMean &mean : means)
            mean.add(p, i);
        });
      }

      DataOut<2>
      patches() const
      {
        DataOut<2> data_out;
        const auto cells = DataOut<2>::DataVectorType::type_cell_data;
        data_out.attach_triangulation(grid.triangulation());
        data_out.add_data_vector(material_id, "material_id", cells);
        data_out.add_data_vector(zone, "zone", cells);
        data_out.add_data_vector(material_points, "material_points", cells);
        std::vector<Vector<double>> values; // which deal.II refers to
        for (const CellMean &mean : means)
          values.push_back(mean.values());
        for (unsigned int i = 0; i < means.size(); ++i)
          data_out.add_data_vector(values[i], means[i].name, cells);
        data_out.build_patches(grid.mapping());
        data_out.clear_input_data_references();
        return data_out;
      }

    private:
      unsigned int
      index(const unsigned int cell) const
      {
        return grid.cell_iterator(cell)->active_cell_index();
      }

      const BackgroundGrid &grid;
      const unsigned int    n_cells;
      Vector<double>        material_id, zone, material_points;
      std::vector<CellMean> means;
    };

    /**
     * The section of the body: the cells of the mesh in it, which follow its
     * surface exactly. All ranks know the lines of the whole mesh, and thus all
     * of the body.
     */
    class BodySection : public DataOutInterface<2>
    {
    public:
      BodySection(const GridLines &lines, const RigidBody &body)
        : travel(body.motion().travel())
        , penetration(body.penetration())
      {
        for (unsigned int i = 0; i < lines.n_cells(); ++i)
          if (lines.is_body_cell(GlobalCell(i)))
            add(lines, lines.tree().block(GlobalCell(i)));
      }

      bool
      empty() const
      {
        return patches.empty();
      }

    private:
      using Patch = DataOutBase::Patch<2>;

      void
      add(const GridLines &lines, const CellBlock &cell)
      {
        Patch patch;
        for (unsigned int corner = 0; corner < 4; ++corner)
          {
            const unsigned int column = cell.column + corner % 2 * cell.size,
                               row    = cell.row + corner / 2 * cell.size;
            patch.vertices[corner]    = lines.node_start(column, row) +
                                     travel * lines.node_rate(column, row);
          }
        patch.patch_index    = patches.size();
        patch.reference_cell = ReferenceCells::Quadrilateral;
        patch.data.reinit(1, 4);
        for (unsigned int corner = 0; corner < 4; ++corner)
          patch.data(0, corner) = penetration;
        patches.push_back(patch);
      }

      const std::vector<Patch> &
      get_patches() const override
      {
        return patches;
      }

      /** Files want a value; this one serves as a label. */
      std::vector<std::string>
      get_dataset_names() const override
      {
        return {"penetration_m"};
      }

      const double       travel, penetration;
      std::vector<Patch> patches;
    };
  } // namespace

  std::string
  FrameText::of_points(const unsigned long long begin,
                       const unsigned long long end) const
  {
    const WrittenFields fields(soil, grid.circumference(), with_pore_pressure);
    PointCloud          cloud(grid, fields);
    cloud.add(points, begin, end);
    auto data_out = cloud.build();
    return vtu_text(data_out, time);
  }

  std::string
  FrameText::of_cells() const
  {
    CellFields cells(grid, soil, with_pore_pressure);
    cells.add(points);
    auto data_out = cells.patches();
    return vtu_text(data_out, time);
  }

  std::string
  FrameText::of_body(const RigidBody &body) const
  {
    BodySection section(grid.lines(), body);
    return section.empty() ? "" : vtu_text(section, time);
  }
} // namespace CaissonMPM
