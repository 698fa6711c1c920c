// Output requests that nothing here serves.
#include <string>

#include "keyword/registry.hpp"

namespace courant {

namespace {

struct DatabaseNodfor : Entry {
  int binary = 0, lcur = 0, ioopt = 0, option2 = 0, option3 = 0, option4 = 0;
  Real dt = 0, option1 = 0;
};
KeywordOf<DatabaseNodfor> database_nodfor() {
  using T = DatabaseNodfor;
  return {.names = {"DATABASE_NODFOR", "DATABASE_ELOUT", "DATABASE_RWFORC", "DATABASE_NCFORC",
                    "DATABASE_SECFORC", "DATABASE_JNTFORC", "DATABASE_DEFORC", "DATABASE_ABSTAT",
                    "DATABASE_SWFORC", "DATABASE_TRHIST", "DATABASE_SPHMASSFLOW", "DATABASE_DISBOUT",
                    "DATABASE_ATDOUT", "DATABASE_GCEOUT", "DATABASE_CURVOUT"},
          .purpose = "interval of a history that is not written here",
          .cards = {{.fields = {{"DT", &T::dt, "T", "interval, 0 none", no_output},
                                {"BINARY", &T::binary, "-", "kind of file", no_effect},
                                {"LCUR", &T::lcur, "-", "curve of the interval", no_effect},
                                {"IOOPT", &T::ioopt, "-", "mode of the curve", no_effect_but(1)},
                                {"OPTION1", &T::option1, "-", "option of some of them", no_effect},
                                {"OPTION2", &T::option2, "-", "option of some of them", no_effect},
                                {"OPTION3", &T::option3, "-", "option of some of them", no_effect},
                                {"OPTION4", &T::option4, "-", "option of some of them", no_effect}}}}};
}
const RegisterKeyword<DatabaseNodfor> database_nodfor_keyword{database_nodfor()};

struct DatabaseFormat : Entry {
  int iform = 0, ibinary = 0;
};
KeywordOf<DatabaseFormat> database_format() {
  using T = DatabaseFormat;
  return {.names = {"DATABASE_FORMAT"},
          .purpose = "format of the binary files: they are VTK and HDF5 here",
          .once = true,
          .many = false,
          .cards = {{.fields = {{"IFORM", &T::iform, "-", "0 LS-DYNA; 1 ANSYS; 2 both", no_effect},
                                {"IBINARY", &T::ibinary, "-", "0 64 bit; 1 32 bit", no_effect}}}}};
}
const RegisterKeyword<DatabaseFormat> database_format_keyword{database_format()};

}  // namespace

}  // namespace courant
