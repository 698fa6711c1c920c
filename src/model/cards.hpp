#pragma once
// Cards of the keywords that belong to no single physics. Field names, columns and meanings: the tables in
// cards_*.cpp.
#include <string>
#include <vector>

#include "keyword/card.hpp"

namespace courant {

struct NodeCard : Entry {
  Id nid;
  Real x, y, z;
  int tc, rc;
};

struct ElementSphCard : Entry {
  Id nid, pid;
  Real mass;
  Id nend;
};

struct ElementShellCard : Entry {
  Id eid, pid, n1, n2, n3, n4;
  Id n5, n6, n7, n8;
  Real thic1, thic2, thic3, thic4, beta;  ///< of _THICKNESS and _BETA
  Real offset;                            ///< of _OFFSET [L]
  bool has_thickness() const { return name % 3 != 0; }
  bool has_beta() const { return name % 3 == 2 || beta != 0; }
  bool has_offset() const { return name >= 3; }
};

struct PartCard : Entry {
  std::string title;
  Id pid, secid, mid, eosid, hgid;
  int grav, adpopt;
  Id tmid;
};
struct PartContactCard : PartCard {
  Real fs, fd, dc, vc, optt, sft, ssf, cparm8;
};

struct DefineCurveCard : Entry {
  std::string title;
  Id lcid;
  int sidr;
  Real sfa, sfo, offa, offo;
  int dattyp, lcint;
  std::vector<Real> a, o;
};

struct DefineBoxCard : Entry {
  std::string title;
  Id boxid;
  Real xmn, xmx, ymn, ymx, zmn, zmx;
};

struct InitialVelocityCard : Entry {
  Id nsid, nsidex, boxid;
  int irigid;
  Id icid;
  Real vx, vy, vz, vxr, vyr, vzr;
  Real vxe, vye, vze, vxre, vyre, vzre;
};

struct InitialVelocityNodeCard : Entry {
  Id nid;
  Real vx, vy, vz, vxr, vyr, vzr;
  Id icid;
};

struct InitialVelocityGenerationCard : Entry {
  Id id;
  int styp;
  Real omega, vx, vy, vz;
  int ivatn;
  Id icid;
  Real xc, yc, zc, nx, ny, nz;
  int phase, irigid;
};

struct BoundarySpcCard : Entry {
  Id id;
  std::string title;
  Id nid;  ///< node, or node set
  Id cid;
  int dofx, dofy, dofz, dofrx, dofry, dofrz;
};
struct BoundarySpcNodeCard : BoundarySpcCard {};
struct BoundarySpcSetCard : BoundarySpcCard {};

struct LoadBodyCard : Entry {  ///< Entry::name is the axis
  Id lcid;
  Real sf;
  Id lciddr;
  Real xc, yc, zc;
  Id cid;
};
struct LoadBodyRotationCard : LoadBodyCard {};
struct LoadBodyVectorCard : LoadBodyCard {
  Real v1, v2, v3;
};
struct LoadBodyPartsCard : Entry {
  Id psid;
};
struct LoadGravityPartCard : Entry {
  bool of_sets() const { return name == 1; }
  Id pid;  ///< part, or part set
  int dof;
  Id lc;
  Real accel;
  Id lcdr;
  int stga, stgr;
};

struct ControlTerminationCard : Entry {
  Real endtim;
  Id endcyc;
  Real dtmin, endeng, endmas;
  int nosol;
};

struct ControlTimestepCard : Entry {
  Real dtinit, tssfac;
  int isdo;
  Real tslimt, dt2ms;
  Id lctm;
  int erode, ms1st;
  Real dt2msf;
  Id dt2mslc;
  int imscl;
  Real rmscl, emscl;
  int ihdo;
  Real rmavg;
  int igado;
  Real dtusr;
  int dtdynv;
};

struct DatabaseD3plotCard : Entry {
  Real dt;
  Id lcdt;
  int beam, npltc;
  Id psetid;
  int ioopt;
  Real rate, cutoff, window;
  int type;
  Id pset;
};

/// Entry::name: 0 GLSTAT, 1 MATSUM, 2 RCFORC, 3 SPHOUT, 4 SLEOUT, 5 NODOUT, 6 RBDOUT, 7 BNDOUT, 8 SPCFORC
struct DatabaseAsciiCard : Entry {
  Real dt;
  int binary;
  Id lcur;
  int ioopt;
  Real option1;
  int option2, option3, option4;
};

struct DatabaseHistorySphCard : Entry {
  std::vector<Id> ids;
};

struct DatabaseHistoryNodeCard : Entry {
  std::vector<Id> ids;
};
struct DatabaseHistoryNodeIdCard : Entry {
  std::vector<Id> ids;
  std::vector<std::string> headings;
};

}  // namespace courant
