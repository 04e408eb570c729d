// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/materials/umat_law.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <utility>

namespace CaissonMPM
{
  namespace
  {
    namespace UserState = Kernels::UserState;

    constexpr auto nothing = UmatArgument::n_arguments;

    std::string
    list_text(const double *list, const std::size_t n)
    {
      std::string text;
      for (std::size_t i = 0; i < n; ++i)
        text += (i > 0 ? ", " : "") + to_text(list[i], 6);
      return text;
    }

    /** F - I, in the order of UserState, as a matrix by columns. */
    void
    set_gradient(const double *f, double *matrix)
    {
      std::fill_n(matrix, 9, 0.);
      matrix[0] = 1. + f[0];
      matrix[3] = f[1];
      matrix[1] = f[2];
      matrix[4] = 1. + f[3];
      matrix[8] = 1. + f[4];
    }

    /** F - I after a step: (I + dt L) F - I. */
    std::array<double, 5>
    next_gradient(const double *f, const double *l)
    {
      return {{f[0] + l[0] * (1. + f[0]) + l[1] * f[2],
               f[1] + l[0] * f[1] + l[1] * (1. + f[3]),
               f[2] + l[2] * (1. + f[0]) + l[3] * f[2],
               f[3] + l[2] * f[1] + l[3] * (1. + f[3]),
               f[4] + l[4] * (1. + f[4])}};
    }

    /**
     * The largest stiffness rho c^2 of plane waves in the r-z plane: for each
     * direction n, the norm of B^T D B, where B takes the amplitude of a wave
     * to
     * its strain (rr, zz, and rz as engineering strain). @p ddsdde by columns.
     */
    double
    acoustic_bound(const std::array<double, 16> &ddsdde)
    {
      constexpr unsigned int n_directions = 36, row[3] = {0, 1, 3};
      double                 largest = 0.;
      for (unsigned int d = 0; d < n_directions; ++d)
        {
          const double angle = pi * d / n_directions, c = std::cos(angle),
                       s       = std::sin(angle);
          const double B[3][2] = {{c, 0.}, {0., s}, {s, c}};
          double       A[2][2] = {};
          for (unsigned int i = 0; i < 3; ++i)
            for (unsigned int j = 0; j < 3; ++j)
              for (unsigned int k = 0; k < 2; ++k)
                for (unsigned int l = 0; l < 2; ++l)
                  A[k][l] += B[i][k] * ddsdde[row[i] + 4 * row[j]] * B[j][l];
          const double p = A[0][0] * A[0][0] + A[1][0] * A[1][0],
                       q = A[0][0] * A[0][1] + A[1][0] * A[1][1],
                       r = A[0][1] * A[0][1] + A[1][1] * A[1][1];
          largest =
            std::max(largest,
                     std::sqrt(.5 * (p + r) + std::hypot(.5 * (p - r), q)));
        }
      return largest;
    }

    double
    largest_diagonal(const std::array<double, 16> &ddsdde)
    {
      return std::max({ddsdde[0], ddsdde[5], ddsdde[10], ddsdde[15]});
    }

    /** What the answers to small strains say. Units: Pa. */
    struct StiffnessByStress
    {
      double largest, trace; // the latter of strains of both signs
    };

    /** Throw BadInput where DDSDDE, of which @p bound and @p diagonal are the
     * largest, cannot be true. */
    void
    check_stiffness(const std::string       &entry,
                    const double             bound,
                    const double             diagonal,
                    const StiffnessByStress &by_stress,
                    const Stress            &at)
    {
      if (by_stress.trace <= 0.)
        throw BadInput(entry +
                       ": the STRESS of the UMAT falls as the strain grows. "
                       "Stress and strain are positive in tension here.");
      if (bound > 100. * by_stress.largest)
        throw BadInput(
          entry + ": the UMAT's DDSDDE has " + to_text(bound, 4) +
          " Pa, but its STRESS answers small strains with no more than " +
          to_text(by_stress.largest, 4) +
          " Pa. The time step follows from DDSDDE: correct it.");
      if (diagonal <= 0. || by_stress.largest > 1.5 * bound)
        throw BadInput(
          entry + ": the UMAT's DDSDDE gives waves a stiffness of at most " +
          to_text(bound, 4) +
          " Pa, but its STRESS answers small strains with " +
          to_text(by_stress.largest, 4) +
          " Pa. The time step follows from DDSDDE: return at least the elastic "
          "stiffness, in Pa, with the components 11, 22, 33, 12.");
      if (bound < std::abs(at[0]) + std::abs(at[1]))
        throw BadInput(entry + ": the stiffness of the UMAT, " +
                       to_text(bound, 4) +
                       " Pa, is less than the stress at the start. If it "
                       "computes in kPa or MPa, set Unit of stress; else "
                       "correct Properties.");
    }
  } // namespace

  UmatLaw::UmatLaw(const UmatSettings &settings,
                   const std::string  &section,
                   const std::string  &directory)
    : settings(settings)
    , section(section)
    , entry(section + "/Library = " + settings.library)
    , library(load_user_library(settings, directory, entry))
    , arguments(settings.n_components,
                settings.n_variables,
                settings.properties.size())
  {
    using namespace UmatArgument;
    std::copy(settings.properties.begin(),
              settings.properties.end(),
              arguments.given(props));
    for (const Index one : {npt, layer, kspt, jstep})
      arguments.give(one, 1);
    arguments.give(ndi, 3);
    arguments.give(nshr, settings.n_components - 3);
    arguments.give(ntens, settings.n_components);
    arguments.give(nstatv, settings.n_variables);
    arguments.give(nprops, settings.properties.size());
    arguments.give(ncrds, settings.n_components == 4 ? 2 : 3);
    arguments.given(drot)[8] = *arguments.given(pnewdt) = 1.;
    std::string name = settings.name.empty() ? section : settings.name;
    for (char &c : name) // SOIL-LAYER-1
      c = c == '/' || c == ' ' ? '-' :
                                 std::toupper(static_cast<unsigned char>(c));
    name.resize(length_of_cmname, ' ');
    std::memcpy(arguments.given(cmname), name.data(), name.size());
  }

  // ------------------------------------------------------------ a call

  void
  UmatLaw::begin_step(const double       time,
                      const double       step_size,
                      const unsigned int step)
  {
    phase               = Phase::step;
    double *const times = arguments.given(UmatArgument::time);
    times[0] = times[1]                   = time;
    *arguments.given(UmatArgument::dtime) = step_size;
    arguments.give(UmatArgument::kinc, static_cast<int>(step + 1));
  }

  void
  UmatLaw::call(void *law, Kernels::UserPoint &point)
  {
    static_cast<UmatLaw *>(law)->update(point);
  }

  void
  UmatLaw::update(Kernels::UserPoint &p)
  {
    if (!failure_.empty())
      return;
    point = &p;
    prepare(p);
    std::string fault =
      guarded_call(*this, [this]() { arguments.call_umat(library.umat); });
    if (fault.empty())
      fault = find_fault();
    if (fault.empty())
      accept(p);
    else
      failure_ = description(fault);
  }

  void
  UmatLaw::initialize(const double r,
                      const double z,
                      const double id,
                      double      *state)
  {
    if (library.sdvini == nullptr || settings.n_variables == 0)
      return;
    double *const variables = state + UserState::variables;
    const Phase   before    = phase;
    phase                   = Phase::start;
    point                   = nullptr;
    set_place(r, z, id);
    std::copy_n(variables,
                settings.n_variables,
                arguments.given(UmatArgument::statev));
    std::string fault =
      guarded_call(*this, [this]() { arguments.call_sdvini(library.sdvini); });
    if (fault.empty())
      fault = find_fault();
    if (!fault.empty())
      throw BadInput(description(fault));
    std::copy_n(arguments.returned(UmatArgument::statev),
                settings.n_variables,
                variables);
    phase = before;
  }

  void
  UmatLaw::set_place(const double r, const double z, const double id)
  {
    double *const coords = arguments.given(UmatArgument::coords);
    coords[0]            = r;
    coords[1]            = z;
    arguments.give(UmatArgument::noel, static_cast<int>(id) + 1);
  }

  void
  UmatLaw::prepare(const Kernels::UserPoint &p)
  {
    using namespace UmatArgument;
    for (unsigned int i = 0; i < 4; ++i)
      arguments.given(stress)[i] = p.stress[i] / settings.unit;
    // the strain so far turns as the stress does
    const double *e = p.state + UserState::strain;
    const double  c = p.cosine, s = p.sine, mean = .5 * (e[0] + e[1]),
                 difference = .5 * (e[0] - e[1]), shear = .5 * e[3],
                 cos2 = c * c - s * s, sin2 = 2. * s * c,
                 turned = cos2 * difference + sin2 * shear;
    double *const sum   = arguments.given(stran);
    sum[0]              = mean + turned;
    sum[1]              = mean - turned;
    sum[2]              = e[2];
    sum[3]              = 2. * (cos2 * shear - sin2 * difference);
    std::copy_n(p.strain, 4, arguments.given(dstran));
    set_place(p.place[0], p.place[1], p.id);
    double *const turn = arguments.given(drot);
    turn[0] = turn[4] = c;
    turn[3]           = s;
    turn[1]           = -s;
    const double *f   = p.state + UserState::gradient;
    set_gradient(f, arguments.given(dfgrd0));
    set_gradient(next_gradient(f, p.gradient).data(), arguments.given(dfgrd1));
    *arguments.given(celent) = p.cell_size;
    std::copy_n(p.state + UserState::variables,
                settings.n_variables,
                arguments.given(statev));
  }

  std::string
  UmatLaw::not_finite(const UmatArgument::Index argument) const
  {
    const double *const begin = arguments.returned(argument),
                        *end  = begin + arguments.size(argument);
    const double *const bad = std::find_if_not(begin, end, [](const double x) {
      return std::isfinite(x);
    });
    if (bad == end)
      return {};
    const auto guard = Arguments::guard_in(*bad);
    if (guard != nothing)
      return outside("read", guard);
    return "has returned a " + std::string(UmatArgument::name(argument)) +
           " that is not finite: " + list_text(begin, end - begin);
  }

  std::string
  UmatLaw::find_fault() const
  {
    using namespace UmatArgument;
    const auto guard = arguments.written_guard();
    if (guard != nothing)
      return outside("written", guard);
    for (const Index argument : {stress, statev, ddsdde})
      if (const std::string fault = not_finite(argument); !fault.empty())
        return fault;
    if (const double factor = *arguments.returned(pnewdt); !(factor >= 1.))
      return "asks for a smaller step by PNEWDT = " + to_text(factor, 4) +
             ", which an explicit step cannot give. Reduce Time/Courant "
             "number, or let the UMAT divide its step";
    return {};
  }

  std::string
  UmatLaw::outside(const std::string &what, const Arguments::Index guard) const
  {
    using namespace UmatArgument;
    const std::string text = "has " + what + " outside ";
    switch (guard)
      {
        case statev:
          return text + "its " + to_text(settings.n_variables) +
                 " State variables. Raise " + section + "/State variables";
        case props:
          return text + "its " + to_text(settings.properties.size()) +
                 " Properties. Give all of them in " + section + "/Properties";
        case stress:
        case ddsdde:
        case ddsddt:
        case drplde:
        case stran:
        case dstran:
          return text + "the " + to_text(settings.n_components) +
                 " components of " + UmatArgument::name(guard) +
                 (settings.n_components == 4 ?
                    ". For a UMAT of three dimensions set " + section +
                      "/Stress components = 6; else NTENS is 4 (11, 22, 33, "
                      "12), and DDSDDE has 4 x 4 numbers" :
                    ". NTENS is 6, and DDSDDE has 6 x 6 numbers");
        case around_all:
          return text + "its arguments";
        default:
          return text + UmatArgument::name(guard);
      }
  }

  std::array<double, 16>
  UmatLaw::stiffness() const
  {
    const double *const    ddsdde = arguments.returned(UmatArgument::ddsdde);
    std::array<double, 16> result;
    for (unsigned int j = 0; j < 4; ++j)
      for (unsigned int i = 0; i < 4; ++i)
        result[i + 4 * j] =
          settings.unit * ddsdde[i + settings.n_components * j];
    return result;
  }

  void
  UmatLaw::accept(Kernels::UserPoint &p)
  {
    using namespace UmatArgument;
    double *const state = p.state;
    for (unsigned int i = 0; i < 4; ++i)
      {
        p.stress[i] = settings.unit * arguments.returned(stress)[i];
        state[UserState::strain + i] =
          arguments.given(stran)[i] + arguments.given(dstran)[i];
      }
    double &modulus = state[UserState::modulus];
    modulus = std::max(modulus, modulus_ratio * largest_diagonal(stiffness()));
    const double *const F = arguments.given(dfgrd1);
    double *const       f = state + UserState::gradient;
    f[0]                  = F[0] - 1.;
    f[1]                  = F[3];
    f[2]                  = F[1];
    f[3]                  = F[4] - 1.;
    f[4]                  = F[8] - 1.;
    std::copy_n(arguments.returned(statev),
                settings.n_variables,
                state + UserState::variables);
  }

  void
  UmatLaw::describe(const char *what, char *text, const std::size_t size) const
  {
    using namespace UmatArgument;
    std::size_t n   = 0;
    const auto  add = [&](const char *format, const auto... values) {
      if (n < size)
        n += std::snprintf(text + n, size - n, format, values...);
    };
    const double *const place = arguments.given(coords);
    add("%s: %s %s. This happened ",
        entry.c_str(),
        phase == Phase::start ? "its SDVINI" : "the UMAT",
        what);
    if (phase == Phase::element_test)
      add("%s", "in the element test before the run");
    else if (phase == Phase::start)
      add("%s", "at the start");
    else
      add("in step %d at t = %.6g s",
          arguments.given_integer(kinc) - 1,
          arguments.given(time)[1]);
    if (phase != Phase::element_test)
      add(", at material point %d at r = %.6g m, z = %.6g m",
          arguments.given_integer(noel) - 1,
          place[0],
          place[1]);
    if (point != nullptr)
      {
        const double *const s = point->stress, *const e = point->strain;
        add(", with the stress %.6g, %.6g, %.6g, %.6g Pa and the strain "
            "increment %.6g, %.6g, %.6g, %.6g (rr, zz, tt, rz), DTIME = %.4g s",
            s[0],
            s[1],
            s[2],
            s[3],
            e[0],
            e[1],
            e[2],
            e[3],
            *arguments.given(dtime));
      }
    add("%s", ".");
  }

  // ------------------------------------------------------------ element test

  std::vector<double>
  UmatLaw::start_of_state(const double       p_wave_modulus,
                          const unsigned int n) const
  {
    std::vector<double> result(n, no_state);
    std::fill_n(result.begin(), n_state(), 0.);
    result[UserState::modulus] = p_wave_modulus;
    std::copy(settings.variables.begin(),
              settings.variables.end(),
              result.begin() + UserState::variables);
    return result;
  }

  UmatLaw::Answer
  UmatLaw::ask(const Stress &at, const std::array<double, 4> &strain)
  {
    constexpr double    rate  = 1e-3; // 1/s
    double              total = 0.;
    std::vector<double> state = start_of_state(0., n_state());
    Kernels::UserPoint  p     = {};
    std::copy(at.begin(), at.end(), p.stress);
    for (unsigned int i = 0; i < 4; ++i)
      {
        p.strain[i] = strain[i];
        total += std::abs(strain[i]);
      }
    p.gradient[0] = strain[0];
    p.gradient[1] = p.gradient[2] = .5 * strain[3];
    p.gradient[3]                 = strain[1];
    p.gradient[4]                 = strain[2];
    p.cosine = p.cell_size                = 1.;
    p.place[0]                            = 1.;
    p.place[1]                            = -depth_of_test;
    p.state                               = state.data();
    *arguments.given(UmatArgument::dtime) = std::max(total, 1e-6) / rate;
    initialize(p.place[0], p.place[1], p.id, state.data());
    update(p);
    if (!failure_.empty())
      throw BadInput(failure_);
    Answer answer;
    std::copy_n(p.stress, 4, answer.stress.begin());
    answer.ddsdde = stiffness();
    answer.variables.assign(state.begin() + UserState::variables, state.end());
    return answer;
  }

  void
  UmatLaw::check_reproducible(const Stress &at)
  {
    const std::array<double, 4> strain = {{1e-6, -2e-6, 1e-6, 1e-6}};
    const Answer                first  = ask(at, strain);
    ask(at, {{-1e-4, 1e-4, 0., 2e-4}});
    const Answer again = ask(at, strain);
    const bool   same  = first.stress == again.stress &&
                      first.ddsdde == again.ddsdde &&
                      first.variables == again.variables;
    if (!same)
      throw BadInput(
        entry + ": the UMAT gives two answers to the same call, the STRESS " +
        list_text(first.stress.data(), 4) + " and, after another call, " +
        list_text(again.stress.data(), 4) +
        " Pa. All that it remembers must be in STATEV (no SAVE, no COMMON), "
        "and it must set all variables that it uses.");
  }

  void
  UmatLaw::check_no_strain(const Stress &at)
  {
    const auto change = [this](const Stress &stress) {
      const Answer answer  = ask(stress, {{0., 0., 0., 0.}});
      double       largest = 0., size = 0.;
      for (unsigned int i = 0; i < 4; ++i)
        {
          largest = std::max(largest, std::abs(answer.stress[i] - stress[i]));
          size    = std::max(size, std::abs(stress[i]));
        }
      return std::make_pair(largest > 1e-3 * size, answer.stress);
    };
    const auto [has_changed, after] = change(at);
    if (!has_changed)
      return;
    const std::string found = "the UMAT changes the STRESS " +
                              list_text(at.data(), 4) + " Pa of the start to " +
                              list_text(after.data(), 4) +
                              " Pa, though the strain increment is zero.";
    // a law with a yield surface keeps the stresses within it
    Stress       half = at, least = at;
    const double mean = (at[0] + at[1] + at[2]) / 3.;
    for (unsigned int i = 0; i < 4; ++i)
      {
        half[i] *= .5;
        least[i] *= 1e-3;
      }
    const Stress isotropic       = {{mean, mean, mean, 0.}},
                 least_isotropic = {
                   {1e-3 * mean, 1e-3 * mean, 1e-3 * mean, 0.}};
    for (const Stress &stress : {half, isotropic, least, least_isotropic})
      if (!change(stress).first)
        {
          warning_ = found +
                     " It keeps smaller ones, so that this one may lie outside "
                     "of its yield surface. Correct Properties, State at the "
                     "start or K0";
          return;
        }
    throw BadInput(entry + ": " + found +
                   " STRESS at entry is the stress at the start of the step: "
                   "add the change to it instead of computing it from STRAN or "
                   "DFGRD1 alone, and check State at the start.");
  }

  void
  UmatLaw::check_start_of_state()
  {
    std::vector<double> state = start_of_state(0., n_state());
    initialize(1., -depth_of_test, 0., state.data());
    if (!std::equal(settings.variables.begin(),
                    settings.variables.end(),
                    state.begin() + UserState::variables))
      warning_ = "SDVINI of the library replaces State at the start. Remove "
                 "the entry, or the routine from the library";
  }

  UmatStiffness
  UmatLaw::test(const Stress &at, const double depth)
  {
    constexpr double strain = 1e-6;
    depth_of_test           = depth;
    check_start_of_state();
    check_reproducible(at);
    check_no_strain(at);
    // 1. DDSDDE of small strains, and what the stress says
    const Answer none  = ask(at, {{0., 0., 0., 0.}});
    double       bound = acoustic_bound(none.ddsdde),
           diagonal = largest_diagonal(none.ddsdde), measured = 0., trace = 0.;
    for (const double sign : {1., -1.})
      {
        std::array<double, 16> found;
        for (unsigned int j = 0; j < 4; ++j)
          {
            std::array<double, 4> e = {{0., 0., 0., 0.}};
            e[j]                    = sign * strain;
            const Answer answer     = ask(at, e);
            bound    = std::max(bound, acoustic_bound(answer.ddsdde));
            diagonal = std::max(diagonal, largest_diagonal(answer.ddsdde));
            for (unsigned int i = 0; i < 4; ++i)
              found[i + 4 * j] =
                (answer.stress[i] - none.stress[i]) / (sign * strain);
          }
        measured = std::max(measured, acoustic_bound(found));
        trace += found[0] + found[5] + found[10] + found[15];
      }
    check_stiffness(entry, bound, diagonal, {measured, trace}, at);
    // 2. whether it changes with the stress
    Stress twice = at;
    for (double &component : twice)
      component *= 2.;
    const double of_twice =
      acoustic_bound(ask(twice, {{0., 0., 0., 0.}}).ddsdde);
    const double change = of_twice - acoustic_bound(none.ddsdde);
    modulus_ratio       = std::max(modulus_ratio, bound / diagonal);
    return {bound,
            std::clamp(none.ddsdde[4] / (none.ddsdde[0] + none.ddsdde[4]),
                       0.,
                       .4999),
            std::abs(change) > 1e-6 * bound};
  }
} // namespace CaissonMPM
