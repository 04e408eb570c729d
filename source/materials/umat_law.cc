// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/materials/umat_law.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <utility>

namespace CaissonMPM
{
  namespace
  {
    namespace UserState = Kernels::UserState;

    constexpr std::size_t bytes = sizeof(double);

    std::string
    path_of(const std::string &directory, const std::string &library)
    {
      namespace fs = std::filesystem;
      return fs::absolute(fs::path(directory) / library)
        .lexically_normal()
        .string();
    }

    struct InputName
    {
      const char *name;
      std::size_t begin, size;
    };

#define CAISSON_INPUT(name, member)                              \
  {                                                              \
    name, offsetof(UmatInput, member), sizeof(UmatInput::member) \
  }
    constexpr InputName input_names[] = {
      CAISSON_INPUT("TIME", time),     CAISSON_INPUT("DTIME", dtime),
      CAISSON_INPUT("TEMP", temp),     CAISSON_INPUT("DTEMP", dtemp),
      CAISSON_INPUT("PREDEF", predef), CAISSON_INPUT("DPRED", dpred),
      CAISSON_INPUT("COORDS", coords), CAISSON_INPUT("DROT", drot),
      CAISSON_INPUT("CELENT", celent), CAISSON_INPUT("DFGRD0", dfgrd0),
      CAISSON_INPUT("DFGRD1", dfgrd1), CAISSON_INPUT("NDI", ndi),
      CAISSON_INPUT("NSHR", nshr),     CAISSON_INPUT("NTENS", ntens),
      CAISSON_INPUT("NSTATV", nstatv), CAISSON_INPUT("NPROPS", nprops),
      CAISSON_INPUT("NOEL", noel),     CAISSON_INPUT("NPT", npt),
      CAISSON_INPUT("LAYER", layer),   CAISSON_INPUT("KSPT", kspt),
      CAISSON_INPUT("JSTEP", jstep),   CAISSON_INPUT("KINC", kinc),
      CAISSON_INPUT("CMNAME", cmname)};
#undef CAISSON_INPUT

    bool
    is_finite(const double *list, const std::size_t n)
    {
      return std::all_of(list, list + n, [](const double x) {
        return std::isfinite(x);
      });
    }

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
    largest_diagonal(const double *ddsdde)
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
                       " Pa, is less than the stress at the start. Give "
                       "Properties such that it computes in Pa.");
    }
  } // namespace

  UmatLaw::UmatLaw(const UmatSettings &settings,
                   const std::string  &section,
                   const std::string  &directory)
    : settings(settings)
    , section(section)
    , entry(section + "/Library = " + settings.library)
    , library(path_of(directory, settings.library), entry)
    , props(bytes * settings.properties.size(), Access::read_only)
    , stran(bytes * 4, Access::read_only)
    , dstran(bytes * 4, Access::read_only)
    , input(sizeof(UmatInput), Access::read_only)
    , stress(bytes * 4, Access::read_and_write)
    , statev(bytes * settings.n_variables, Access::read_and_write)
    , ddsdde(bytes * 16, Access::read_and_write)
  {
    std::copy(settings.properties.begin(),
              settings.properties.end(),
              props.own<double>());
    UmatInput &in = given();
    in.npt = in.layer = in.kspt = in.jstep[0] = 1;
    in.ndi                                    = 3;
    in.nshr                                   = 1;
    in.ntens                                  = 4;
    in.nstatv                                 = settings.n_variables;
    in.nprops                                 = settings.properties.size();
    in.drot[8]                                = 1.;
    std::fill_n(in.cmname, sizeof(in.cmname), ' ');
    std::string name = section; // SOIL-LAYER-1
    std::replace_if(
      name.begin(),
      name.end(),
      [](const char c) { return c == '/' || c == ' '; },
      '-');
    for (std::size_t i = 0; i < name.size(); ++i)
      in.cmname[i] = std::toupper(static_cast<unsigned char>(name[i]));
  }

  // ------------------------------------------------------------ a call

  void
  UmatLaw::begin_step(const double       time,
                      const double       step_size,
                      const unsigned int step)
  {
    UmatInput &in = given();
    is_testing    = false;
    in.time[0] = in.time[1] = time;
    in.dtime                = step_size;
    in.kinc                 = static_cast<int>(step + 1);
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
    const int status = static_cast<int>(is_testing ? ExitStatus::bad_input :
                                                     ExitStatus::failure);
    const EndOfCall end =
      guarded_call(&UmatLaw::call_umat, this, &UmatLaw::text_of_exit, status);
    if (end == EndOfCall::returned && is_good())
      accept(p);
    else
      failure_ = describe(find_fault(end));
  }

  void
  UmatLaw::prepare(const Kernels::UserPoint &p)
  {
    UmatInput &in = given();
    std::copy_n(p.stress, 4, stress.own<double>());
    // the strain so far turns as the stress does
    const double *e = p.state + UserState::strain;
    const double  c = p.cosine, s = p.sine, mean = .5 * (e[0] + e[1]),
                 difference = .5 * (e[0] - e[1]), shear = .5 * e[3],
                 cos2 = c * c - s * s, sin2 = 2. * s * c,
                 turned = cos2 * difference + sin2 * shear;
    double *const sum   = stran.own<double>();
    sum[0]              = mean + turned;
    sum[1]              = mean - turned;
    sum[2]              = e[2];
    sum[3]              = 2. * (cos2 * shear - sin2 * difference);
    std::copy_n(p.strain, 4, dstran.own<double>());
    std::copy_n(p.place, 2, in.coords);
    double *const turn = in.drot;
    turn[0] = turn[4] = c;
    turn[3]           = s;
    turn[1]           = -s;
    const double *f   = p.state + UserState::gradient;
    set_gradient(f, in.dfgrd0);
    set_gradient(next_gradient(f, p.gradient).data(), in.dfgrd1);
    in.celent = p.cell_size;
    in.noel   = static_cast<int>(p.id) + 1;
    std::copy_n(p.state + UserState::variables,
                settings.n_variables,
                statev.own<double>());
    std::fill_n(ddsdde.own<double>(), 16, 0.);
    pnewdt = 1.;
  }

  void
  UmatLaw::call_umat(void *law)
  {
    UmatLaw   &l   = *static_cast<UmatLaw *>(law);
    UmatInput &in  = *l.input.lent<UmatInput>();
    double     sse = 0., spd = 0., scd = 0., rpl = 0., drpldt = 0.;
    double     ddsddt[4] = {}, drplde[4] = {};
    l.library.umat()(l.stress.lent<double>(),
                     l.statev.lent<double>(),
                     l.ddsdde.lent<double>(),
                     &sse,
                     &spd,
                     &scd,
                     &rpl,
                     ddsddt,
                     drplde,
                     &drpldt,
                     l.stran.lent<double>(),
                     l.dstran.lent<double>(),
                     in.time,
                     &in.dtime,
                     &in.temp,
                     &in.dtemp,
                     &in.predef,
                     &in.dpred,
                     in.cmname,
                     &in.ndi,
                     &in.nshr,
                     &in.ntens,
                     &in.nstatv,
                     l.props.lent<double>(),
                     &in.nprops,
                     in.coords,
                     in.drot,
                     &l.pnewdt,
                     &in.celent,
                     in.dfgrd0,
                     in.dfgrd1,
                     &in.noel,
                     &in.npt,
                     &in.layer,
                     &in.kspt,
                     in.jstep,
                     &in.kinc,
                     sizeof(in.cmname));
  }

  std::string
  UmatLaw::text_of_exit(void *law)
  {
    return static_cast<const UmatLaw *>(law)->describe(
      "has ended the program (STOP or exit). A UMAT should call XIT");
  }

  bool
  UmatLaw::is_good() const
  {
    return is_finite(stress.own<double>(), 4) &&
           is_finite(statev.own<double>(), settings.n_variables) &&
           is_finite(ddsdde.own<double>(), 16) && pnewdt >= 1.;
  }

  std::string
  UmatLaw::find_fault(const EndOfCall end) const
  {
    if (end == EndOfCall::stopped)
      return "has called XIT, or STDB_ABQERR with an error";
    if (end != EndOfCall::returned)
      {
        const std::string what = beyond_or_read_only(address_of_crash());
        return !what.empty() ? what :
                               "has crashed with " + name_of_signal(end) +
                                 ". Compile it with -g -fcheck=all to find out "
                                 "where";
      }
    const unsigned int n = settings.n_variables;
    if (!is_finite(stress.own<double>(), 4))
      return "has returned the STRESS " + list_text(stress.own<double>(), 4);
    if (!is_finite(statev.own<double>(), n))
      return "has returned a STATEV that is not finite: " +
             list_text(statev.own<double>(), n);
    if (!is_finite(ddsdde.own<double>(), 16))
      return "has returned a DDSDDE that is not finite: " +
             list_text(ddsdde.own<double>(), 16);
    return "asks for a smaller step by PNEWDT = " + to_text(pnewdt, 4) +
           ", which an explicit step cannot give. Reduce Time/Courant number, "
           "or let the UMAT divide its step";
  }

  std::string
  UmatLaw::beyond_or_read_only(const void *address) const
  {
    const std::string beyond = "has read or written beyond ";
    for (const auto &[name, memory] : {std::make_pair("STRESS", &stress),
                                       std::make_pair("DDSDDE", &ddsdde),
                                       std::make_pair("STRAN", &stran),
                                       std::make_pair("DSTRAN", &dstran)})
      if (memory->is_behind(address))
        return beyond + "the 4 components of " + name +
               ". NTENS is 4 here (11, 22, 33, 12), and DDSDDE has 4 x 4 "
               "numbers: a UMAT for NTENS = 6 needs its arrays by NTENS";
    if (statev.is_behind(address))
      return beyond + "its " + to_text(settings.n_variables) +
             " State variables. Raise " + section + "/State variables";
    if (props.is_behind(address))
      return beyond + "its " + to_text(settings.properties.size()) +
             " Properties. Give all of them in " + section + "/Properties";
    std::string name = stran.is_inside(address)  ? "STRAN" :
                       dstran.is_inside(address) ? "DSTRAN" :
                       props.is_inside(address)  ? "PROPS" :
                                                   "";
    for (const InputName &n : input_names)
      if (input.is_inside(address) &&
          input.distance_to(address) - n.begin < n.size)
        name = n.name;
    return name.empty() ? "" :
                          "has written to " + name +
                            ", which a UMAT may only read. Let it work on a "
                            "copy";
  }

  void
  UmatLaw::accept(Kernels::UserPoint &p)
  {
    double *const state = p.state;
    std::copy_n(stress.own<double>(), 4, p.stress);
    double &modulus = state[UserState::modulus];
    modulus =
      std::max(modulus, modulus_ratio * largest_diagonal(ddsdde.own<double>()));
    for (unsigned int i = 0; i < 4; ++i)
      state[UserState::strain + i] =
        stran.own<double>()[i] + dstran.own<double>()[i];
    const double *const F = given().dfgrd1;
    double *const       f = state + UserState::gradient;
    f[0]                  = F[0] - 1.;
    f[1]                  = F[3];
    f[2]                  = F[1];
    f[3]                  = F[4] - 1.;
    f[4]                  = F[8] - 1.;
    std::copy_n(statev.own<double>(),
                settings.n_variables,
                state + UserState::variables);
  }

  std::string
  UmatLaw::describe(const std::string &what) const
  {
    const UmatInput &in   = given();
    std::string      text = entry + ": the UMAT " + what + ". This happened ";
    if (is_testing)
      text += "in the element test before the run";
    else
      text += "in step " + to_text(in.kinc - 1) +
              " at t = " + to_text(in.time[1], 6) + " s, at material point " +
              to_text(in.noel - 1) + " at r = " + to_text(in.coords[0], 6) +
              " m, z = " + to_text(in.coords[1], 6) + " m";
    return text + ", with the stress " + list_text(point->stress, 4) +
           " Pa and the strain increment " + list_text(point->strain, 4) +
           " (rr, zz, tt, rz), DTIME = " + to_text(in.dtime, 4) + " s.";
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
    p.cosine = p.cell_size = 1.;
    p.place[0]             = 1.;
    p.state                = state.data();
    given().dtime          = std::max(total, 1e-6) / rate;
    update(p);
    if (!failure_.empty())
      throw BadInput(failure_);
    Answer answer;
    std::copy_n(stress.own<double>(), 4, answer.stress.begin());
    std::copy_n(ddsdde.own<double>(), 16, answer.ddsdde.begin());
    answer.variables.assign(statev.own<double>(),
                            statev.own<double>() + settings.n_variables);
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

  UmatStiffness
  UmatLaw::test(const Stress &at)
  {
    constexpr double strain = 1e-6;
    check_reproducible(at);
    check_no_strain(at);
    // 1. DDSDDE of small strains, and what the stress says
    const Answer none  = ask(at, {{0., 0., 0., 0.}});
    double       bound = acoustic_bound(none.ddsdde),
           diagonal = largest_diagonal(none.ddsdde.data()), measured = 0.,
           trace = 0.;
    for (const double sign : {1., -1.})
      {
        std::array<double, 16> found;
        for (unsigned int j = 0; j < 4; ++j)
          {
            std::array<double, 4> e = {{0., 0., 0., 0.}};
            e[j]                    = sign * strain;
            const Answer answer     = ask(at, e);
            bound = std::max(bound, acoustic_bound(answer.ddsdde));
            diagonal =
              std::max(diagonal, largest_diagonal(answer.ddsdde.data()));
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
