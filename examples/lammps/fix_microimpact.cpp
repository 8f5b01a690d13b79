/* A LAMMPS fix: the surface z = 0, which spheres hit as microimpact simulates it.

   fix ID group microimpact/wall stiffness K [adhesion f0] [zeta_a A] [dmt G] [jkr G] [zeta_h H] [friction f] [record FILE]

   Numbers in SI units, so `units si`. What is not given is absent; of the ring (adhesion f0 in N/m), dmt and jkr (works of adhesion
   in J/m^2) at most one may be given, and zeta_a only with the ring. A sphere of the group whose edge has passed the surface, and that
   moves towards it, gets the velocity and the spin after the impact, on the surface. A captured sphere keeps no normal velocity. An
   impact that is undecided, or that the simulation does not solve, holds the sphere too, and so does one slower than 1e-12 m/s, which is
   no hit. A sphere that is held stays on the surface against forces towards it, as gravity, without further hits; a force away from the
   surface takes it along, and the next time that it reaches the surface is another hit. Vector of the fix: numbers of hits so far of
   each class, in the order of MicroimpactClass, and of those without a result. With `record`, each rank writes its hits to FILE.RANK
   after each run: per hit 15 doubles, tag, radius, velocity and spin before, class, velocity and spin after. */

#include <mpi.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <set>
#include <string>
#include <vector>

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "fix.h"
#include "lammps.h"
#include "update.h"
#include "utils.h"

#include "microimpact.h"

using namespace LAMMPS_NS;

namespace {

/* Six classes, and no result. */
constexpr int CLASSES = 7;
constexpr int NO_RESULT = CLASSES - 1;

/* The slowest approach that the library simulates, m/s. A slower sphere rests. */
constexpr double SLOWEST = 1e-12;

/* A sphere that the library takes, with which the numbers of the material are checked before there is a hit: radius in m, density in
   kg/m^3. */
constexpr float ANY_RADIUS = 1e-6f, ANY_DENSITY = 1e3f;

class FixWall : public Fix {
 public:
  FixWall(LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg) {
    if (strcmp(update->unit_style, "si") != 0)
      error->all(FLERR, "fix microimpact/wall: units {} is refused: it computes in SI units; use units si", update->unit_style);
    std::set<std::string> given;
    for (int i = 3; i < narg; i += 2) {
      if (i + 1 >= narg) error->all(FLERR, "fix microimpact/wall: {} has no value", arg[i]);
      if (!given.insert(arg[i]).second) error->all(FLERR, "fix microimpact/wall: {} is given twice; leave one out", arg[i]);
      if (strcmp(arg[i], "record") == 0) {
        record_file = std::string(arg[i + 1]) + "." + std::to_string(comm->me);
        continue;
      }
      float *number = named(arg[i]);
      if (!number)
        error->all(FLERR, "fix microimpact/wall: there is no {}; give stiffness, adhesion, zeta_a, dmt, jkr, zeta_h, friction or record",
                   arg[i]);
      *number = static_cast<float>(utils::numeric(FLERR, arg[i + 1], false, lmp));
    }
    if (!given.count("stiffness")) error->all(FLERR, "fix microimpact/wall: stiffness is missing; give it in Pa");
    if (given.count("adhesion") + given.count("dmt") + given.count("jkr") > 1)
      error->all(FLERR, "fix microimpact/wall: a surface has one adhesion; give one of adhesion, dmt and jkr");
    if (given.count("zeta_a") && !given.count("adhesion"))
      error->all(FLERR, "fix microimpact/wall: zeta_a is the damping of the ring; give adhesion too, or leave it out");
    MicroimpactContactScene scene = of(ANY_RADIUS, ANY_DENSITY);
    MicroimpactError refused = {};
    demand(microimpact_contact_init(&scene, &scene, &refused), refused, "");
    if (!atom->radius_flag || !atom->omega_flag || !atom->rmass_flag)
      error->all(FLERR, "fix microimpact/wall: spheres are needed; use atom_style sphere");
    vector_flag = 1;
    size_vector = CLASSES;
    extvector = 1;
    global_freq = 1;
    create_attribute = 1;
    maxexchange = 1;
    FixWall::grow_arrays(atom->nmax);
    atom->add_callback(Atom::GROW);
  }

  ~FixWall() override { atom->delete_callback(id, Atom::GROW); }

  int setmask() override { return FixConst::POST_INTEGRATE; }

  void post_integrate() override {
    for (int i = 0; i < atom->nlocal; i++) {
      if (!(atom->mask[i] & groupbit)) continue;
      if (atom->x[i][2] > atom->radius[i]) {
        held[i] = 0;
      } else if (atom->v[i][2] < 0.0) {
        if (held[i] || atom->v[i][2] > -SLOWEST)
          hold(i);
        else
          hit(i);
      }
    }
  }

  /* Which spheres are held goes with them, also to other ranks. */
  void grow_arrays(int most) override { held.resize(most, 0); }
  void copy_arrays(int from, int to, int) override { held[to] = held[from]; }
  void set_arrays(int i) override { held[i] = 0; }
  int pack_exchange(int i, double *buffer) override {
    buffer[0] = held[i];
    return 1;
  }
  int unpack_exchange(int i, double *buffer) override {
    held[i] = static_cast<char>(buffer[0]);
    return 1;
  }
  double memory_usage() override { return static_cast<double>(held.capacity()); }

  void post_run() override {
    if (record_file.empty()) return;
    FILE *file = fopen(record_file.c_str(), "wb");
    const bool written = file && fwrite(records.data(), sizeof(double), records.size(), file) == records.size();
    const bool closed = file && fclose(file) == 0;
    if (!written || !closed) error->one(FLERR, "fix microimpact/wall: cannot write {}", record_file);
  }

  double compute_vector(int i) override {
    double all = 0.0;
    MPI_Allreduce(&counts[i], &all, 1, MPI_DOUBLE, MPI_SUM, world);
    return all;
  }

 private:
  MicroimpactContactScene material = {};
  double counts[CLASSES] = {};
  std::string record_file;
  std::vector<double> records;
  /* Whether the surface holds each sphere. */
  std::vector<char> held;

  float *named(const char *name) {
    if (strcmp(name, "stiffness") == 0) return &material.stiffness;
    if (strcmp(name, "adhesion") == 0) return &material.adhesion_strength;
    if (strcmp(name, "dmt") == 0) return &material.dmt_work;
    if (strcmp(name, "jkr") == 0) return &material.jkr_work;
    if (strcmp(name, "zeta_h") == 0) return &material.material_damping;
    if (strcmp(name, "zeta_a") == 0) return &material.adhesion_damping;
    if (strcmp(name, "friction") == 0) return &material.friction;
    return nullptr;
  }

  /* The scene of a sphere on the surface. */
  MicroimpactContactScene of(float radius, float density) const {
    MicroimpactContactScene scene = material;
    scene.radius = radius;
    scene.density = density;
    return scene;
  }

  void demand(MicroimpactStatus status, const MicroimpactError &refused, const std::string &of_what) {
    if (status == MICROIMPACT_STATUS_OK) return;
    char name[MICROIMPACT_LARGEST_TEXT] = "", unit[MICROIMPACT_LARGEST_TEXT] = "";
    microimpact_parameter_name(refused.parameter, name, sizeof name);
    microimpact_parameter_unit(refused.parameter, unit, sizeof unit);
    const std::string in_unit = strcmp(unit, "1") == 0 ? "" : std::string(" ") + unit;
    error->one(FLERR, "fix microimpact/wall: {}{} is {:g}{}, but must be {:g} to {:g}{} (status {})", name, of_what, refused.value, in_unit,
               refused.smallest, refused.largest, in_unit, static_cast<int>(status));
  }

  void hold(int i) {
    held[i] = 1;
    atom->x[i][2] = atom->radius[i];
    atom->v[i][2] = 0.0;
  }

  void hit(int i) {
    const double r = atom->radius[i], *v = atom->v[i], *w = atom->omega[i];
    const MicroimpactWall wall = {{0.0f, 0.0f, 1.0f}, {0.0f, 0.0f, 0.0f}};
    MicroimpactSpatialMotion before = {}, after = {};
    for (int k = 0; k < 3; k++) {
      before.velocity[k] = static_cast<float>(v[k]);
      before.spin[k] = static_cast<float>(w[k]);
    }
    const std::string of_atom = " of atom " + std::to_string(atom->tag[i]);
    MicroimpactContactScene scene =
        of(static_cast<float>(r), static_cast<float>(atom->rmass[i] / (4.0 / 3.0 * M_PI * r * r * r)));
    MicroimpactMotion planar;
    MicroimpactContact end;
    MicroimpactError refused = {};
    size_t written = 0;
    demand(microimpact_contact_init(&scene, &scene, &refused), refused, of_atom);
    demand(microimpact_wall_incidence(&wall, scene.radius, &before, &planar, &refused), refused, of_atom);
    const MicroimpactStatus status = microimpact_simulate(&scene, &planar, 1, &end, 1, &written, &refused);
    int impact_class = NO_RESULT;
    if (status != MICROIMPACT_STATUS_UNSOLVED) {
      demand(status, refused, of_atom);
      impact_class = static_cast<int>(end.impact_class);
    }
    after = before;
    if (impact_class < static_cast<int>(MICROIMPACT_CLASS_UNDECIDED))
      demand(microimpact_wall_after(&wall, scene.radius, &before, end.restitution, end.tangential, &after, &refused), refused, of_atom);
    else
      after.velocity[2] = 0.0f;
    held[i] = impact_class >= static_cast<int>(MICROIMPACT_CLASS_CAPTURED_SLIDING);
    counts[impact_class] += 1.0;
    if (!record_file.empty()) {
      records.insert(records.end(), {static_cast<double>(atom->tag[i]), r, v[0], v[1], v[2], w[0], w[1], w[2]});
      records.push_back(impact_class);
      for (float part : after.velocity) records.push_back(part);
      for (float part : after.spin) records.push_back(part);
    }
    // A step may have carried it beyond the surface.
    atom->x[i][2] = r;
    for (int k = 0; k < 3; k++) {
      atom->v[i][k] = after.velocity[k];
      atom->omega[i][k] = after.spin[k];
    }
  }
};

/* LAMMPS's interface of plugins, whose header is not installed with LAMMPS. */
struct Plugin {
  const char *version, *style, *name, *info, *author;
  union {
    void *(*v1)(void *);
    void *(*v2)(void *, int, char **);
  } creator;
  void *handle;
};

void *create(void *lmp, int narg, char **arg) {
  return new FixWall(static_cast<LAMMPS *>(lmp), narg, arg);
}

}    // namespace

extern "C" void lammpsplugin_init(void *lmp, void *handle, void *registrar) {
  Plugin plugin = {};
  plugin.version = static_cast<LAMMPS *>(lmp)->version;
  plugin.style = "fix";
  plugin.name = "microimpact/wall";
  plugin.info = "impacts of microspheres by the contact simulation of microimpact";
  plugin.author = "the authors of microimpact";
  plugin.creator.v2 = create;
  plugin.handle = handle;
  reinterpret_cast<void (*)(Plugin *, void *)>(registrar)(&plugin, lmp);
}
