// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/materials/umat_arguments.h>

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <new>
#include <utility>

namespace CaissonMPM
{
  using namespace UmatArgument;

  namespace
  {
    // sizes that are not fixed
    enum Size
    {
      components = -4,
      square,
      variables,
      properties
    };

    /** Names and sizes, in numbers of 8 bytes. */
    constexpr std::pair<const char *, int> arguments[n_arguments] = {
      // clang-format off
      {"STRESS", components}, {"STATEV", variables}, {"DDSDDE", square},
      {"SSE", 1}, {"SPD", 1}, {"SCD", 1}, {"RPL", 1}, {"DDSDDT", components},
      {"DRPLDE", components}, {"DRPLDT", 1}, {"STRAN", components},
      {"DSTRAN", components}, {"TIME", 2}, {"DTIME", 1}, {"TEMP", 1},
      {"DTEMP", 1}, {"PREDEF", 1}, {"DPRED", 1},
      {"CMNAME", length_of_cmname / 8}, {"NDI", 1}, {"NSHR", 1}, {"NTENS", 1},
      {"NSTATV", 1}, {"PROPS", properties}, {"NPROPS", 1}, {"COORDS", 3},
      {"DROT", 9}, {"PNEWDT", 1}, {"CELENT", 1}, {"DFGRD0", 9}, {"DFGRD1", 9},
      {"NOEL", 1}, {"NPT", 1}, {"LAYER", 1}, {"KSPT", 1}, {"JSTEP", 2},
      {"KINC", 1}, {"NCRDS", 1}
      // clang-format on
    };

    // the bits of a quiet NaN, with a mark and the number of an argument
    constexpr std::uint64_t mark = 0x7ff8ca1550000000, labels = 0x3f;
    static_assert(around_all <= labels, "the mark has no room for more");

    constexpr std::size_t out_of_reach = 1 << 20; // bytes on each side

    /** Numbers that fill whole pages, between others that cannot be used. */
    std::shared_ptr<double>
    guarded_pages(const std::size_t n)
    {
      const std::size_t size = n * sizeof(double),
                        all  = size + 2 * out_of_reach;
      void *const room =
        mmap(nullptr, all, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
      if (room == MAP_FAILED)
        throw std::bad_alloc();
      char *const begin = static_cast<char *>(room) + out_of_reach;
      const auto  free  = [room, all](double *) { munmap(room, all); };
      const std::shared_ptr<double> result(reinterpret_cast<double *>(begin),
                                           free);
      if (mprotect(begin, size, PROT_READ | PROT_WRITE) != 0)
        throw std::bad_alloc();
      return result;
    }

    std::uint64_t
    bits_of(const double number)
    {
      std::uint64_t bits;
      std::memcpy(&bits, &number, sizeof(bits));
      return bits;
    }

    double
    guard_word(const unsigned int argument)
    {
      const std::uint64_t bits = mark + argument;
      double              word;
      std::memcpy(&word, &bits, sizeof(word));
      return word;
    }

    /** Call with as many addresses as there are in the list. */
    template <std::size_t>
    using Address = void *;

    template <std::size_t... i>
    void
    call(const Routine      routine,
         double            *numbers,
         const std::size_t *places,
         std::index_sequence<i...>)
    {
      using Called = void (*)(Address<i>..., std::size_t);
      reinterpret_cast<Called>(routine)((numbers + places[i])...,
                                        length_of_cmname);
    }
  } // namespace

  const char *
  UmatArgument::name(const unsigned int argument)
  {
    return arguments[argument].first;
  }

  UmatArguments::UmatArguments(const unsigned int n_components,
                               const unsigned int n_variables,
                               const unsigned int n_properties)
  {
    // single numbers have no guard, and lengths that are mistaken at times a
    // longer one
    constexpr std::size_t few = 4, many = 32;
    const std::size_t     of_size[] = {n_components,
                                       n_components * n_components,
                                       n_variables,
                                       n_properties};
    const auto add_guard = [this](const unsigned int i, const std::size_t n) {
      for (std::size_t k = 0; k < n; ++k)
        {
          guard_words.push_back(own.size());
          own.push_back(guard_word(i));
        }
    };
    for (unsigned int i = 0; i < n_arguments; ++i)
      {
        const int size = arguments[i].second;
        if (size != 1)
          add_guard(i, few);
        sizes[i]  = size < 0 ? of_size[size - components] : size;
        places[i] = own.size();
        own.insert(own.end(), sizes[i], 0.);
        const bool is_mistaken =
          size == square || size == variables || size == properties;
        if (size != 1)
          add_guard(i, is_mistaken ? many : few);
      }
    end                    = own.size();
    const std::size_t page = sysconf(_SC_PAGESIZE) / sizeof(double);
    own.resize((end + page - 1) / page * page, guard_word(around_all));
    lent = guarded_pages(own.size());
    std::copy(own.begin(), own.end(), lent.get());
  }

  void
  UmatArguments::call_umat(const Routine umat)
  {
    std::copy_n(own.begin(), end, lent.get());
    call(umat,
         lent.get(),
         places.data(),
         std::make_index_sequence<n_of_umat>());
  }

  void
  UmatArguments::call_sdvini(const Routine sdvini)
  {
    std::copy_n(own.begin(), end, lent.get());
    const std::size_t of_sdvini[] = {places[statev],
                                     places[coords],
                                     places[nstatv],
                                     places[ncrds],
                                     places[noel],
                                     places[npt],
                                     places[layer],
                                     places[kspt]};
    call(sdvini, lent.get(), of_sdvini, std::make_index_sequence<8>());
  }

  UmatArguments::Index
  UmatArguments::written_guard() const
  {
    // 4 at a time, which do not wait for each other: guards have 4 or 32
    const double *const words         = lent.get();
    std::uint64_t       difference[4] = {};
    for (std::size_t i = 0; i < guard_words.size(); i += 4)
      for (std::size_t k = 0; k < 4; ++k)
        difference[k] |= bits_of(words[guard_words[i + k]]) ^ mark;
    if ((difference[0] | difference[1] | difference[2] | difference[3]) >
        labels)
      return guard_in(own[*std::find_if(
        guard_words.begin(), guard_words.end(), [&](const unsigned int i) {
          return bits_of(words[i]) != bits_of(own[i]);
        })]);
    return std::memcmp(words + end,
                       own.data() + end,
                       (own.size() - end) * sizeof(double)) == 0 ?
             n_arguments :
             around_all;
  }

  UmatArguments::Index
  UmatArguments::guard_in(const double number)
  {
    constexpr std::uint64_t sign  = std::uint64_t(1) << 63;
    const std::uint64_t     guard = (bits_of(number) & ~sign) - mark;
    return guard <= around_all ? static_cast<Index>(guard) : n_arguments;
  }
} // namespace CaissonMPM
