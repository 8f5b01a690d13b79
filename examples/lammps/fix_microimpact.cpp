/* A LAMMPS fix: the surface z = 0, which spheres hit as microimpact simulates it.

   fix ID group microimpact/wall stiffness K [adhesion f0] [zeta_a A] [dmt G] [jkr G] [zeta_h H] [friction f] [record FILE]

   Numbers in SI units, so `units si`. What is not given is absent; of the ring (adhesion f0 in N/m), dmt and jkr (works of adhesion
   in J/m^2) at most one may be given. A sphere of the group whose edge has passed the surface, and that moves towards it, gets the
   velocity and the spin after the impact, on the surface. A captured sphere keeps no normal velocity. An impact that is undecided, or that the
   simulation does not solve, holds the sphere too. Vector of the fix: numbers of hits so far of each class, in the order of
   MicroimpactClass, and of those without a result. With `record`, each rank writes its hits to FILE.RANK after each run: per hit
   15 doubles, tag, radius, velocity and spin before, class, velocity and spin after. */

#include <mpi.h>

#include <cmath>
#include <cstdio>
#include <cstring>
#include <string>
#include <vector>

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "fix.h"
#include "lammps.h"
#include "utils.h"

#include "microimpact.h"

using namespace LAMMPS_NS;

namespace {

/* Six classes, and no result. */
constexpr int CLASSES = 7;
constexpr int NO_RESULT = CLASSES - 1;

class FixWall : public Fix {
 public:
  FixWall(LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg) {
    for (int i = 3; i < narg; i += 2) {
      if (i + 1 >= narg) error->all(FLERR, "fix microimpact/wall: {} has no value", arg[i]);
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
    if (!atom->radius_flag || !atom->omega_flag || !atom->rmass_flag)
      error->all(FLERR, "fix microimpact/wall: spheres are needed; use atom_style sphere");
    vector_flag = 1;
    size_vector = CLASSES;
    extvector = 1;
    global_freq = 1;
  }

  int setmask() override { return FixConst::POST_INTEGRATE; }

  void post_integrate() override {
    for (int i = 0; i < atom->nlocal; i++)
      if ((atom->mask[i] & groupbit) && atom->v[i][2] < 0.0 && atom->x[i][2] <= atom->radius[i]) hit(i);
  }

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

  void demand(MicroimpactStatus status, const MicroimpactError &refused, int i) {
    if (status == MICROIMPACT_STATUS_OK) return;
    char name[64] = "";
    microimpact_parameter_name(refused.parameter, name, sizeof name);
    error->one(FLERR, "fix microimpact/wall: {} of atom {} must be {} to {} (status {})", name, atom->tag[i], refused.smallest,
               refused.largest, static_cast<int>(status));
  }

  void hit(int i) {
    const double r = atom->radius[i], *v = atom->v[i], *w = atom->omega[i];
    const MicroimpactWall wall = {{0.0f, 0.0f, 1.0f}, {0.0f, 0.0f, 0.0f}};
    MicroimpactSpatialMotion before = {}, after = {};
    for (int k = 0; k < 3; k++) {
      before.velocity[k] = static_cast<float>(v[k]);
      before.spin[k] = static_cast<float>(w[k]);
    }
    MicroimpactContactScene scene = material;
    scene.radius = static_cast<float>(r);
    scene.density = static_cast<float>(atom->rmass[i] / (4.0 / 3.0 * M_PI * r * r * r));
    MicroimpactMotion planar;
    MicroimpactContact end;
    MicroimpactError refused = {};
    size_t written = 0;
    demand(microimpact_contact_init(&scene, &scene, &refused), refused, i);
    demand(microimpact_wall_incidence(&wall, scene.radius, &before, &planar, &refused), refused, i);
    const MicroimpactStatus status = microimpact_simulate(&scene, &planar, 1, &end, 1, &written, &refused);
    int impact_class = NO_RESULT;
    if (status != MICROIMPACT_STATUS_UNSOLVED) {
      demand(status, refused, i);
      impact_class = static_cast<int>(end.impact_class);
    }
    after = before;
    if (impact_class < static_cast<int>(MICROIMPACT_CLASS_UNDECIDED))
      demand(microimpact_wall_after(&wall, scene.radius, &before, end.restitution, end.tangential, &after, &refused), refused, i);
    else
      after.velocity[2] = 0.0f;
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
