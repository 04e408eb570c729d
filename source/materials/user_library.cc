// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/fingerprint.h>
#include <caisson_mpm/base/guarded_call.h>
#include <caisson_mpm/base/text.h>
#include <caisson_mpm/materials/user_library.h>

#include <dlfcn.h>
#include <link.h>

#include <algorithm>
#include <cfenv>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <map>
#include <sstream>
#include <system_error>

namespace CaissonMPM
{
  namespace
  {
    /** A call of dlopen(), which runs code of the library. */
    struct Opening
    {
      const std::string &path, &entry;
      void              *handle;
    };

    void
    open_library(void *argument)
    {
      auto &opening  = *static_cast<Opening *>(argument);
      opening.handle = dlopen(opening.path.c_str(), RTLD_NOW | RTLD_LOCAL);
    }

    std::string
    text_of_exit_while_opening(void *argument)
    {
      return static_cast<Opening *>(argument)->entry +
             ": the library ends the program while it is loaded.";
    }

    std::string
    content_of(const std::string &path)
    {
      std::ifstream      file(path, std::ios::binary);
      std::ostringstream content;
      content << file.rdbuf();
      return content.str();
    }

    const std::string how_to_compile =
      "gfortran -shared -fPIC -O2 -o NAME.so NAME.f90";

    using Header = ElfW(Ehdr);

    /** The first numbers of a library or a program; in other files they mean
     * nothing. */
    Header
    header_of(const std::string &content)
    {
      Header header = {};
      std::memcpy(&header,
                  content.data(),
                  std::min(content.size(), sizeof(header)));
      return header;
    }

    std::string
    name_of_processor(const unsigned int number)
    {
      static const std::map<unsigned int, std::string> names = {
        {EM_X86_64, "x86-64"},
        {EM_AARCH64, "ARM of 64 bits"},
        {EM_386, "x86 of 32 bits"},
        {EM_ARM, "ARM of 32 bits"},
        {EM_RISCV, "RISC-V"},
        {EM_PPC64, "POWER"}};
      const auto found = names.find(number);
      return found == names.end() ? "processors of number " + to_text(number) :
                                    found->second;
    }

    /** Say why the content of a file cannot be a library for this machine;
     * empty where it can be one. */
    std::string
    reason_not_to_load(const std::string &content)
    {
      if (content.empty())
        return "is empty or cannot be read. Compile the library again";
      if (content.compare(0, SELFMAG, ELFMAG) != 0)
        return "is no compiled library, but text or data. Name the file that "
               "the compiler has made of it";
      const auto its = header_of(content),
                 own = header_of(content_of("/proc/self/exe"));
      if (its.e_machine != own.e_machine ||
          its.e_ident[EI_CLASS] != own.e_ident[EI_CLASS])
        return "is a library for " + name_of_processor(its.e_machine) +
               ", and this program runs on " +
               name_of_processor(own.e_machine) +
               ". Compile it on this machine";
      if (its.e_type != ET_DYN)
        return "is an object file or a program. Compile it as a shared library";
      return "";
    }

    /** Throw BadInput where the file cannot be a library. */
    void
    check_file(const std::string &path, const std::string &entry)
    {
      namespace fs = std::filesystem;
      std::error_code error;
      const auto      status = fs::status(path, error);
      if (!fs::exists(status))
        throw BadInput(entry + ": there is no file " + path +
                       ". The path is relative to the file that sets it. "
                       "Correct it, or compile the library: " +
                       how_to_compile + ".");
      const std::string reason =
        fs::is_regular_file(status) ?
          reason_not_to_load(content_of(path)) :
          std::string("is ") +
            (fs::is_directory(status) ? "a directory" : "no file") +
            ". Name the file of the library";
      if (!reason.empty())
        throw BadInput(entry + ": " + path + " " + reason + " (" +
                       how_to_compile + ").");
    }

    void *
    load(const std::string &path, const std::string &entry)
    {
      check_file(path, entry);
      Opening opening = {path, entry, nullptr};
      // a library that was compiled with -ffast-math changes how all of the
      // program computes
      std::fenv_t arithmetic;
      std::fegetenv(&arithmetic);
      const EndOfCall end =
        guarded_call(open_library,
                     &opening,
                     text_of_exit_while_opening,
                     static_cast<int>(ExitStatus::bad_input));
      std::fesetenv(&arithmetic);
      if (end != EndOfCall::returned)
        throw BadInput(entry +
                       ": the library crashes while it is loaded, with " +
                       name_of_signal(end) + ". Correct it.");
      if (opening.handle == nullptr)
        throw BadInput(
          entry + " cannot be loaded: " + dlerror() +
          ". Compile it as a shared library for this machine (gfortran -shared "
          "-fPIC), with all routines that it calls: of those of Abaqus the "
          "program has XIT, STDB_ABQERR, GETOUTDIR and GETJOBNAME only.");
      return opening.handle;
    }

    /** The text with the next number or word for each %I, %R and %S. */
    std::string
    text_of_message(const std::string &text,
                    const int         *whole_numbers,
                    const double      *numbers,
                    const char        *words)
    {
      constexpr std::size_t length_of_word = 8;
      std::ostringstream    message;
      for (std::size_t i = 0; i < text.size(); ++i)
        {
          const std::string mark = text.substr(i, 2);
          i += mark == "%I" || mark == "%R" || mark == "%S" ? 1 : 0;
          if (mark == "%I")
            message << *whole_numbers++;
          else if (mark == "%R")
            message << *numbers++;
          else if (mark == "%S")
            {
              message << std::string(words, length_of_word);
              words += length_of_word;
            }
          else
            message << text[i];
        }
      return message.str();
    }
  } // namespace

  UserLibrary::UserLibrary(const std::string &path, const std::string &entry)
  {
    void *const handle = load(path, entry);
    for (const char *const name : {"umat_", "umat", "UMAT"})
      if (umat_ == nullptr)
        umat_ = reinterpret_cast<Umat>(dlsym(handle, name));
    if (umat_ == nullptr)
      throw BadInput(entry +
                     " has no symbol umat_, umat or UMAT. Write a subroutine "
                     "UMAT outside of any module (in C: void umat_), and "
                     "compile it with gfortran -shared -fPIC.");
    checksum_ = fingerprint_of(content_of(path));
  }
} // namespace CaissonMPM

// ------------------------------------------------------------ for libraries

extern "C"
{
  /** End the analysis. */
  void
  xit_()
  {
    CaissonMPM::leave_guarded_call();
  }

  /** Print a message; @p lop = -3 ends the analysis. */
  void
  stdb_abqerr_(const int        *lop,
               const char       *text,
               const int        *whole_numbers,
               const double     *numbers,
               const char       *words,
               const std::size_t length)
  {
    constexpr int most      = 20; // a step has many points
    static int    n_printed = 0;
    if (n_printed++ < most)
      std::cerr << "user material: "
                << CaissonMPM::text_of_message(std::string(text, length),
                                               whole_numbers,
                                               numbers,
                                               words)
                << std::endl;
    if (*lop <= -3)
      CaissonMPM::leave_guarded_call();
  }

  /** The directory of results: libraries get that of the process. */
  void
  getoutdir_(char *directory, int *length, const std::size_t room)
  {
    std::memset(directory, ' ', room);
    if (room > 0)
      directory[0] = '.';
    *length = 1;
  }

  void
  getjobname_(char *name, int *length, const std::size_t room)
  {
    const std::string job = "caisson_mpm";
    std::memset(name, ' ', room);
    *length = std::min(job.size(), room);
    std::copy_n(job.begin(), *length, name);
  }
}
