#pragma once
#include "contact/contact_cards.hpp"
#include "keyword/card.hpp"

namespace courant {

class Deck;
class Diagnostics;

/// *CONTACT_AUTOMATIC_NODES_TO_SURFACE and similar keywords; field names and units as in the keywords' table.
struct ContactCard : Entry {
  Id cid = 0;
  std::string title;
  Id surfa = 0, surfb = 0, saboxid = 0, sbboxid = 0;
  int surfatyp = 0, surfbtyp = 0, sapr = 0, sbpr = 0;
  Real fs = 0, fd = 0, dc = 0, vc = 0, vdc = 0, bt = 0, dt = 1e20;
  int penchk = 0;
  Real sfsa = 1, sfsb = 1, sast = 0, sbst = 0, sfsat = 1, sfsbt = 1, fsf = 1, vsf = 1;
  int soft = 0, lcidab = 0, sbopt = 2, depth = 2, bsort = 0, frcfrq = 1;
  Real sofscl = 0.1, maxpar = 1.025;
  Real penmax = 0, sldthk = 0, sldstf = 0;
  int thkopt = 0, shlthk = 0, snlog = 0, isym = 0, i2d3d = 0;
  int igap = 1, ignore = 0, cid_rcf = 0;
  Real dprfac = 0, dtstif = 0, edgek = 0, flangl = 0;
  int q2tri = 0, tcso = 0, tiedid = 0, shledg = 0;
  Real dtpchk = 0, sfnbr = 0, fnlscl = 0, dnlscl = 0;
  int sharec = 0, cparm8 = 0, ipback = 0, srnde = 0, icor = 0, ftorq = 0, region = 0;
  Real fricsf = 1;
  int pstiff = 0, ignroff = 0, binr = 0, ssftyp = 0, swtpr = 0;
  Real fstol = 2, tetfac = 0, shloff = 0;
  int erode_isym = 0, erosop = 0, iadj = 0;  ///< of eroding contacts
  int option = 0, tblcid = 0, thkoff = 0;    ///< of tiebreak contacts
  Real kpf = 0;
  Real nfls = 0, sfls = 0, param = 0, eraten = 0, erates = 0, ct2cn = 0, cn = 0, nen = 2, mes = 2;
};

/// Nodes tied to faces until a stress, or a force, breaks the tie.
enum class Tiebreak {
  none,
  by_option,  ///< stress, by OPTION
  stress,
  force,
};

/// Properties given by the name of a *CONTACT.
struct ContactKind {
  bool automatic = true;     ///< faces of shells act on both sides, with their thickness
  bool single = false;       ///< one surface with itself
  bool symmetric = false;    ///< also nodes of SURFB on faces of SURFA
  bool nodes = false;        ///< SURFA gives nodes, which may be particles
  bool edges = false;        ///< also edges on edges, and beams
  bool inner = false;        ///< all edges of shells, not only free ones
  bool eroding = false;      ///< also faces exposed by deleted solids
  bool forming = false;      ///< rigid tools without thickness, blanks with theirs
  const char* runs_as = "";  ///< the method used, if it differs from that of the name
  Tiebreak tiebreak = Tiebreak::none;
};
ContactKind kind_of(const ContactCard& card);
/// Whether edges touch edges: by the name, or SOFT 2 with such a DEPTH.
bool asks_for_edges(const ContactCard& card);
/// FS 0 with FD > 0 has no static friction.
void warn_of_sliding(const Deck& deck, const ContactCard& card, Diagnostics& diagnostics);

}  // namespace courant
