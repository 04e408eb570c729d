// SPDX-License-Identifier: LGPL-2.1-or-later
#include <caisson_mpm/base/exceptions.h>
#include <caisson_mpm/base/fingerprint.h>
#include <caisson_mpm/base/guarded_call.h>
#include <caisson_mpm/base/text_file.h>
#include <caisson_mpm/materials/user_library.h>

#include <boost/algorithm/string/case_conv.hpp>

#include <dlfcn.h>

#include <cstdio>
#include <filesystem>

namespace CaissonMPM
{
  namespace
  {
    /** The code that a library runs while it is loaded. */
    struct LoadedCode : ForeignCode
    {
      const char *entry;

      void
      describe(const char       *what,
               char             *text,
               const std::size_t size) const override
      {
        std::snprintf(
          text, size, "%s: while it is loaded, the library %s.", entry, what);
      }
    };

    void *
    load(const std::string &path, const std::string &entry)
    {
      const std::string compile =
        "gfortran -shared -fPIC -O2 -o NAME.so NAME.f90";
      std::error_code error;
      if (!std::filesystem::is_regular_file(path, error))
        throw BadInput(entry + ": there is no file " + path +
                       (std::filesystem::exists(path, error) ?
                          ", but something else of this name. " :
                          ". The path is relative to the file that sets it. ") +
                       "Correct it, or compile the library: " + compile + ".");
      void      *handle = nullptr;
      LoadedCode code;
      code.entry              = entry.c_str();
      const std::string fault = guarded_call(code, [&]() {
        handle = dlopen(path.c_str(), RTLD_NOW | RTLD_LOCAL);
      });
      if (!fault.empty())
        throw BadInput(code.description(fault));
      if (handle == nullptr)
        throw BadInput(
          entry + " is no shared library that this machine can load: " +
          dlerror() + ". Compile it here (" + compile +
          "), with all routines that it calls: of those of Abaqus the program "
          "has XIT, STDB_ABQERR, GETOUTDIR, GETJOBNAME, SINV, SPRINC, SPRIND "
          "and ROTSIG.");
      return handle;
    }

    /** The routine that compilers of Fortran and C make of the name. */
    Routine
    find(void *const handle, const std::string &name)
    {
      const std::string lower = boost::algorithm::to_lower_copy(name),
                        upper = boost::algorithm::to_upper_copy(name);
      std::string in_module   = "__" + lower; // of gfortran
      if (const auto colons = in_module.find("::"); colons != std::string::npos)
        in_module.replace(colons, 2, "_MOD_");
      void *found = nullptr;
      for (const std::string &symbol :
           {lower + "_", name + "_", name, upper, in_module})
        if (found == nullptr)
          found = dlsym(handle, symbol.c_str());
      return reinterpret_cast<Routine>(found);
    }
  } // namespace

  UserLibrary
  load_user_library(const UmatSettings &settings,
                    const std::string  &directory,
                    const std::string  &entry)
  {
    namespace fs = std::filesystem;
    const std::string path =
      fs::absolute(fs::path(directory) / settings.library)
        .lexically_normal()
        .string();
    void *const   handle = load(path, entry);
    const Routine umat   = find(handle, settings.routine);
    if (umat == nullptr)
      throw BadInput(entry + " has no subroutine " + settings.routine +
                     " (symbol " + settings.routine +
                     "_). Set Routine to the name of its UMAT, or to "
                     "MODULE::NAME where it stands in a module of Fortran; in "
                     "C++ it is extern \"C\".");
    return {umat, find(handle, "sdvini"), fingerprint_of(read_text(path))};
  }
} // namespace CaissonMPM
