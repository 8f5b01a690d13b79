/* microimpact for C: impacts of microspheres. Made by cbindgen from examples/c/src; all units SI, all numbers float. */

#ifndef MICROIMPACT_H
#define MICROIMPACT_H

#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

// Least room for a trajectory: first touch, peak, beginning of rolling and end.
#define MICROIMPACT_SMALLEST_TRAJECTORY 4

// Room that is always enough: no trajectory has more samples.
#define MICROIMPACT_LARGEST_TRAJECTORY 64

// How a function has ended.
enum MicroimpactStatus
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  // All is well, and the results are there.
  MICROIMPACT_STATUS_OK,
  // A pointer that is null or misaligned; there is no result.
  MICROIMPACT_STATUS_POINTER,
  // A number outside its range: the error says which.
  MICROIMPACT_STATUS_INPUT,
  // The simulation did not come to an end within its budget; nothing was written for this motion.
  MICROIMPACT_STATUS_UNSOLVED,
  // Fewer results fit than there are motions, and those that fit were written; or no trajectory fits.
  MICROIMPACT_STATUS_CAPACITY,
  // A table that was never made.
  MICROIMPACT_STATUS_UNMADE,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum MicroimpactStatus MicroimpactStatus;
#else
typedef uint32_t MicroimpactStatus;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// How a number misses its range.
enum MicroimpactFault
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  // No fault.
  MICROIMPACT_FAULT_NONE,
  // NaN or infinite.
  MICROIMPACT_FAULT_NOT_FINITE,
  // Below the smallest valid value.
  MICROIMPACT_FAULT_TOO_SMALL,
  // Above the largest valid value.
  MICROIMPACT_FAULT_TOO_LARGE,
  // A term that does not go with the others of the scene.
  MICROIMPACT_FAULT_OTHER_LAW,
  // Bodies that do not approach each other along the normal.
  MICROIMPACT_FAULT_RECEDING,
  // Any other fault.
  MICROIMPACT_FAULT_OTHER,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum MicroimpactFault MicroimpactFault;
#else
typedef uint32_t MicroimpactFault;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// What became of the sphere.
enum MicroimpactClass
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  // Leaves the surface while its contact point slips.
  MICROIMPACT_CLASS_REBOUND_SLIDING,
  // Leaves the surface rolling.
  MICROIMPACT_CLASS_REBOUND_ROLLING,
  // Captured, and slides on.
  MICROIMPACT_CLASS_CAPTURED_SLIDING,
  // Captured, and rolls on.
  MICROIMPACT_CLASS_CAPTURED_ROLLING,
  // Captured and at rest.
  MICROIMPACT_CLASS_CAPTURED_RESTING,
  // Too close to the critical speed to decide.
  MICROIMPACT_CLASS_UNDECIDED,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum MicroimpactClass MicroimpactClass;
#else
typedef uint32_t MicroimpactClass;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// What a table says of an impact.
enum MicroimpactVerdict
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  // The sphere leaves the surface.
  MICROIMPACT_VERDICT_REBOUND,
  // The surface holds the sphere.
  MICROIMPACT_VERDICT_CAPTURE,
  // The speed is closer to the critical one than the error of the table.
  MICROIMPACT_VERDICT_TOO_CLOSE_TO_CALL,
  // The table does not reach there.
  MICROIMPACT_VERDICT_OUTSIDE_TABLE,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum MicroimpactVerdict MicroimpactVerdict;
#else
typedef uint32_t MicroimpactVerdict;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// The motion along the surface after a rebound.
enum MicroimpactSurfaceMotion
#if defined(__cplusplus) || __STDC_VERSION__ >= 202311L
  : uint32_t
#endif // defined(__cplusplus) || __STDC_VERSION__ >= 202311L
 {
  // There is no rebound.
  MICROIMPACT_SURFACE_MOTION_NONE,
  // The contact point slips.
  MICROIMPACT_SURFACE_MOTION_SLIDING,
  // The sphere rolls.
  MICROIMPACT_SURFACE_MOTION_ROLLING,
};
#ifndef __cplusplus
#if __STDC_VERSION__ >= 202311L
typedef enum MicroimpactSurfaceMotion MicroimpactSurfaceMotion;
#else
typedef uint32_t MicroimpactSurfaceMotion;
#endif // __STDC_VERSION__ >= 202311L
#endif // __cplusplus

// A rigid body with R = k/(k + v), a work of adhesion and friction. Zero leaves a term out.
typedef struct MicroimpactRigidScene {
  // Radius of the sphere, m.
  float radius;
  // Its density, kg/m^3.
  float density;
  // Speed k of the restitution law, m/s.
  float restitution_speed;
  // Work of adhesion, J; may be zero.
  float work_of_adhesion;
  // Friction coefficient; may be zero.
  float friction;
} MicroimpactRigidScene;

// What was wrong with a number.
typedef struct MicroimpactError {
  // Which number, for microimpact_parameter_name.
  uint32_t parameter;
  // What is wrong with it.
  MicroimpactFault fault;
  // Smallest valid value.
  double smallest;
  // Largest valid value.
  double largest;
} MicroimpactError;

// A motion before the impact.
typedef struct MicroimpactMotion {
  // Approach speed, positive, m/s.
  float approach;
  // Tangential velocity, m/s.
  float tangential;
  // Peripheral velocity, spin times radius, m/s.
  float peripheral;
} MicroimpactMotion;

// The class of an impact, and what goes with it. A margin that does not exist is negative.
typedef struct MicroimpactClassification {
  // What became of the sphere.
  MicroimpactClass impact_class;
  // Approach speed over the critical speed.
  float speed_over_critical;
  // Friction over the least that ends sliding.
  float friction_over_limit;
  // Overall restitution, zero for a capture.
  float restitution;
  // Tangential velocity after the impact, m/s.
  float tangential;
  // Peripheral velocity after the impact, m/s.
  float peripheral;
} MicroimpactClassification;

// A contact with Hertz's force, adhesion of one kind, damping of one kind, and friction. Zero leaves a term out.
typedef struct MicroimpactContactScene {
  // Radius of the sphere, m.
  float radius;
  // Its density, kg/m^3.
  float density;
  // Hertz stiffness, Pa.
  float stiffness;
  // Strength zeta_H of hysteretic damping in the materials; may be zero. A damping constant c in s/m of the elastic force times
  // 1 + c v is zeta_H (m/(r^3 K sqrt(v)))^(2/5), with mass m, radius r, stiffness K and approach speed v.
  float material_damping;
  // Strength of the ring of adhesion, N/m; may be zero.
  float adhesion_strength;
  // Strength of the damping of adhesion; may be zero.
  float adhesion_damping;
  // Friction coefficient; may be zero.
  float friction;
  // Tolerance of the square of the restitution; microimpact_contact_init fills in 1e-6.
  float tolerance;
  // Work of adhesion by Derjaguin, Muller and Toporov, J/m^2; may be zero.
  float dmt_work;
  // Work of adhesion by Johnson, Kendall and Roberts, J/m^2; may be zero.
  float jkr_work;
  // Relaxation time of viscoelastic damping, s; may be zero.
  float relaxation_time;
  // Restitution that constant damping leaves without adhesion, 0.001 to 1; zero leaves the damping out.
  float nominal_restitution;
  // Zero for an end of contact at zero indentation, or where a JKR contact snaps off. Anything else for an end where damping
  // cancels the elastic force, or at the pull-off force of a JKR contact; the ring and DMT have no such end.
  uint32_t ends_by_force;
} MicroimpactContactScene;

// A simulated impact. An indentation that does not exist is negative.
typedef struct MicroimpactContact {
  // What became of the sphere.
  MicroimpactClass impact_class;
  // Overall restitution, zero for a capture.
  float restitution;
  // Peak indentation, m.
  float peak_indentation;
  // Tangential velocity after the contact, m/s.
  float tangential;
  // Spin after the contact, rad/s.
  float spin;
} MicroimpactContact;

// The wall that a sphere hits, at rest or moving.
typedef struct MicroimpactWall {
  // Direction from the wall to the sphere, a vector of length one; within 1e-3 of it, the length is set to one.
  float normal[3];
  // Velocity of the surface of the wall at the contact, m/s; zeros for a wall at rest.
  float velocity[3];
} MicroimpactWall;

// The motion of a solid sphere in space.
typedef struct MicroimpactSpatialMotion {
  // Velocity of the centre, m/s.
  float velocity[3];
  // Spin, rad/s.
  float spin[3];
} MicroimpactSpatialMotion;

// Two solid spheres that collide.
typedef struct MicroimpactPair {
  // Radius of each sphere, m.
  float radius[2];
  // Density of each sphere, kg/m^3.
  float density[2];
  // Direction from the centre of the second sphere to that of the first, a vector of length one; within 1e-3 of it, the
  // length is set to one.
  float normal[3];
  // Motion of each sphere before the impact.
  struct MicroimpactSpatialMotion motion[2];
} MicroimpactPair;

// The critical speeds of spheres of one material on one surface, over a range of radii. Made by microimpact_boundary_make,
// or a constant that `cargo microimpact table` has written.
typedef struct MicroimpactBoundaryTable {
  // Radius at which the table begins, m.
  float smallest_radius;
  // Greatest error of the logarithm of a critical speed, in 2^-23 octaves.
  uint32_t margin;
  // Cells, in flash or in memory of the caller: a quarter of an octave of radii each.
  const int32_t (*cells)[4];
  // Their number.
  size_t count;
} MicroimpactBoundaryTable;

// Room for a table of restitution over two octaves of radii and a range of speeds, which microimpact_restitution_make makes.
typedef struct MicroimpactRestitutionTable {
  // What is in it concerns the library alone.
  uint32_t words[165];
} MicroimpactRestitutionTable;

// What a restitution table says of an impact.
typedef struct MicroimpactTableReading {
  // Rebound or capture.
  MicroimpactVerdict verdict;
  // Sliding or rolling.
  MicroimpactSurfaceMotion surface_motion;
  // Overall restitution; zero for a capture, negative where the table has no answer.
  float restitution;
  // Greatest error of the restitution; zero for a capture, negative where the table has no answer.
  float restitution_error;
  // Tangential velocity after a rebound, m/s; else zero.
  float tangential;
  // Peripheral velocity after a rebound, m/s; else zero.
  float peripheral;
} MicroimpactTableReading;

// A contact that gives sideways before it slips: one elastic element between sphere and surface sticks until friction is exhausted
// (Mindlin 1949; Thornton, Cummins and Cleary 2011).
typedef struct MicroimpactCompliantScene {
  // The contact: Hertz's force with material_damping and friction, any of which may be zero. All that belongs to another law,
  // adhesion, other damping and ends_by_force, must be zero.
  struct MicroimpactContactScene contact;
  // Stiffness ratio chi, 0.001 to 1000: the stiffness along the surface over (3/2) K a, with the Hertz stiffness K and the contact
  // radius a. It is 2 (1 - nu)/(2 - nu) for two materials with the same Poisson's ratio nu.
  float stiffness_ratio;
  // How the force along the surface changes while the contact shrinks. Zero: it falls with the stiffness, so that no energy is
  // created. Anything else: it does not, as in many programs for granular flow; this rule creates energy.
  uint32_t incremental_unloading;
} MicroimpactCompliantScene;

// A simulated impact with compliance along the surface.
typedef struct MicroimpactCompliantContact {
  // What became of the sphere. Where friction acts, the contact slips in the end.
  MicroimpactClass impact_class;
  // Overall restitution.
  float restitution;
  // Peak indentation, m.
  float peak_indentation;
  // Tangential velocity after the contact, m/s.
  float tangential;
  // Spin after the contact, rad/s.
  float spin;
  // Velocity of the contact point after the contact, m/s.
  float slip;
  // Tangential over normal impulse, negative against a positive slip.
  float impulse_ratio;
  // Number of phases: longest intervals of sticking, or of slip in one direction.
  uint32_t phases;
} MicroimpactCompliantContact;

// A moment of a simulated impact.
typedef struct MicroimpactSample {
  // Time from first touch, s.
  float time;
  // Indentation, m.
  float indentation;
  // Its rate, m/s: positive on the way in, negative on the way out, zero at the peak.
  float velocity;
  // Normal force of the surface on the sphere, N, positive where it repels.
  float force;
  // Its elastic part, N.
  float elastic;
} MicroimpactSample;

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

// Initialises a scene with parameters, of which what is left out is zero, and checks every one. The error names the first that
// is outside its range, and may be null. Where this fails, the scene holds zeros, which every function reports. The parameters
// and the scene may be the same memory.
//
// # Safety
// Each pointer is null or points to what its type says, and nobody else uses it during the call.
MicroimpactStatus microimpact_rigid_init(const struct MicroimpactRigidScene *parameters,
                                         struct MicroimpactRigidScene *scene,
                                         struct MicroimpactError *error);

// Classifies an impact of a rigid body. The error may be null.
//
// # Safety
// Each pointer is null or points to what its type says, and nobody else uses it during the call.
MicroimpactStatus microimpact_classify(const struct MicroimpactRigidScene *scene,
                                       const struct MicroimpactMotion *motion,
                                       struct MicroimpactClassification *result,
                                       struct MicroimpactError *error);

// Initialises a scene with parameters, of which what is left out is zero, fills in the tolerance if it is, and checks every
// one. The error names the first that is outside its range, and may be null. Where this fails, the scene holds zeros, which
// every function reports. The parameters and the scene may be the same memory.
//
// # Safety
// Each pointer is null or points to what its type says, and nobody else uses it during the call.
MicroimpactStatus microimpact_contact_init(const struct MicroimpactContactScene *parameters,
                                           struct MicroimpactContactScene *scene,
                                           struct MicroimpactError *error);

// Simulates `count` impacts into a buffer with room for `capacity` results, in the order of the motions, and writes how many
// there are, of those before the first that fails. The error may be null.
//
// # Safety
// Each pointer is null or points to what its type says, the motions to `count` of them and the results to room for
// `capacity`, and nobody else uses them during the call.
MicroimpactStatus microimpact_simulate(const struct MicroimpactContactScene *scene,
                                       const struct MicroimpactMotion *motions,
                                       size_t count,
                                       struct MicroimpactContact *results,
                                       size_t capacity,
                                       size_t *written,
                                       struct MicroimpactError *error);

// Computes the planar motion of a solid sphere of the given radius (m) that hits a wall. microimpact_classify and
// microimpact_simulate take it, with a scene of the same radius.
//
// The plane contains the normal and the velocity with which the contact point slips on the wall. The sphere keeps its velocity
// across that plane (microimpact_wall_sideways), so that a class such as rolling or resting describes the motion in the plane.
//
// It is an error with the fault MICROIMPACT_FAULT_RECEDING if the sphere does not approach the wall. Where this fails, nothing
// is written but the error, which may be null.
//
// # Safety
// Each pointer is null or points to what its type says, and nobody else uses it during the call.
MicroimpactStatus microimpact_wall_incidence(const struct MicroimpactWall *wall,
                                             float radius,
                                             const struct MicroimpactSpatialMotion *motion,
                                             struct MicroimpactMotion *planar,
                                             struct MicroimpactError *error);

// Computes the velocity of a solid sphere across the plane of its impact on a wall (m/s), seen from the wall: from what
// microimpact_wall_incidence takes. The sphere keeps it. So a sphere of MICROIMPACT_CLASS_CAPTURED_RESTING rests only if this
// velocity is zero, and else rolls sideways with it. Where this fails, nothing is written but the error, which may be null.
//
// # Safety
// Each pointer is null or points to what its type says, and nobody else uses it during the call.
MicroimpactStatus microimpact_wall_sideways(const struct MicroimpactWall *wall,
                                            float radius,
                                            const struct MicroimpactSpatialMotion *motion,
                                            float *sideways,
                                            struct MicroimpactError *error);

// Computes the motion in space of a solid sphere after its impact on a wall: from the wall, the radius (m) and the motion that
// microimpact_wall_incidence took, and from the overall restitution (0 to 1) and the tangential velocity (m/s) that
// microimpact_classify, microimpact_simulate or microimpact_simulate_compliant returned for its planar motion.
//
// With a restitution of zero, the sphere stays on the wall. An impact of MICROIMPACT_CLASS_UNDECIDED has that restitution, too,
// but the motion after it is not known: do not call this function for it.
//
// The motions before and after may be the same memory. Where this fails, nothing is written but the error, which may be null.
//
// # Safety
// Each pointer is null or points to what its type says, and nobody else uses it during the call.
MicroimpactStatus microimpact_wall_after(const struct MicroimpactWall *wall,
                                         float radius,
                                         const struct MicroimpactSpatialMotion *motion,
                                         float restitution,
                                         float tangential,
                                         struct MicroimpactSpatialMotion *after,
                                         struct MicroimpactError *error);

// Computes the reduced sphere of two solid spheres that collide, whose impact on a wall is equivalent to the collision: its
// radius (m), its density (kg/m^3) and its planar motion. Initialise a scene with this radius and this density;
// microimpact_classify, microimpact_simulate and microimpact_simulate_compliant then take the planar motion. All other parameters of the scene are those of the
// contact of the two spheres, and a work of adhesion in joules is that of the relative motion.
//
// The tangential velocity is that with which the spheres slip on each other, and the peripheral velocity is zero.
//
// It is an error with the fault MICROIMPACT_FAULT_RECEDING if the spheres do not approach each other. Where this fails, nothing
// is written but the error, which may be null.
//
// # Safety
// Each pointer is null or points to what its type says, and nobody else uses it during the call.
MicroimpactStatus microimpact_pair_incidence(const struct MicroimpactPair *pair,
                                             float *radius,
                                             float *density,
                                             struct MicroimpactMotion *planar,
                                             struct MicroimpactError *error);

// Computes the motions in space of two solid spheres after their collision: from the pair that microimpact_pair_incidence took,
// and from the overall restitution (0 to 1) and the tangential velocity (m/s) that microimpact_classify, microimpact_simulate or
// microimpact_simulate_compliant returned for its planar motion. There is room for two motions, those of the first and of the second sphere.
//
// With a restitution of zero, the spheres stay in contact. An impact of MICROIMPACT_CLASS_UNDECIDED has that restitution, too, but
// the motions after it are not known: do not call this function for it.
//
// The motions after the impact may be in the memory of those of the pair. Where this fails, nothing is written but the error,
// which may be null.
//
// # Safety
// Each pointer is null or points to what its type says, the motions to room for two of them, and nobody else uses them during
// the call.
MicroimpactStatus microimpact_pair_after(const struct MicroimpactPair *pair,
                                         float restitution,
                                         float tangential,
                                         struct MicroimpactSpatialMotion *after,
                                         struct MicroimpactError *error);

// Writes the name of a parameter and a zero byte to a buffer, cut off where it is too small, and returns the length of the
// whole name, zero for a parameter that there is not.
//
// # Safety
// The buffer is null or has room for `capacity` bytes.
size_t microimpact_parameter_name(uint32_t parameter,
                                  char *buffer,
                                  size_t capacity);

// Makes a boundary table of the material and the surface of a scene, whose radius and friction do not count, from a radius on
// (m), in cells of the caller, which the table keeps pointing to. Where it fails, the cells hold no table. The error may be
// null.
//
// # Safety
// Each pointer is null or points to what its type says, the cells to room for `count` of them, and nobody else uses them
// during the call.
MicroimpactStatus microimpact_boundary_make(const struct MicroimpactContactScene *scene,
                                            float smallest_radius,
                                            int32_t (*cells)[4],
                                            size_t count,
                                            struct MicroimpactBoundaryTable *table,
                                            struct MicroimpactError *error);

// Checks all of a boundary table: a constant once, at start-up. The error may be null.
//
// # Safety
// Each pointer is null or points to what its type says, and nobody else uses it during the call; so do the cells.
MicroimpactStatus microimpact_boundary_check(const struct MicroimpactBoundaryTable *table,
                                             struct MicroimpactError *error);

// Tells rebound from capture of a sphere of a radius (m). Of the table, the cell around that radius is checked. The error may
// be null.
//
// # Safety
// Each pointer is null or points to what its type says, and nobody else uses it during the call; so do the cells.
MicroimpactStatus microimpact_boundary_classify(const struct MicroimpactBoundaryTable *table,
                                                float radius,
                                                const struct MicroimpactMotion *motion,
                                                MicroimpactVerdict *verdict,
                                                struct MicroimpactError *error);

// Makes a restitution table of the material, the surface and the friction of a scene, whose radius does not count: over two
// octaves of radii from one on (m), and up to `speed_ratio` times the critical speed. The error may be null.
//
// # Safety
// Each pointer is null or points to what its type says, and nobody else uses it during the call.
MicroimpactStatus microimpact_restitution_make(const struct MicroimpactContactScene *scene,
                                               float smallest_radius,
                                               float speed_ratio,
                                               struct MicroimpactRestitutionTable *table,
                                               struct MicroimpactError *error);

// Reads from a table what becomes of a sphere of a radius (m). The error may be null.
//
// # Safety
// Each pointer is null or points to what its type says, and nobody else uses it during the call.
MicroimpactStatus microimpact_restitution_read(const struct MicroimpactRestitutionTable *table,
                                               float radius,
                                               const struct MicroimpactMotion *motion,
                                               struct MicroimpactTableReading *reading,
                                               struct MicroimpactError *error);

// Initialises a scene as microimpact_contact_init does, with the tolerance of its contact. If another law of contact is asked for, the
// error names the stiffness ratio with the fault MICROIMPACT_FAULT_OTHER_LAW.
//
// # Safety
// Each pointer is null or points to what its type says, and nobody else uses it during the call.
MicroimpactStatus microimpact_compliant_init(const struct MicroimpactCompliantScene *parameters,
                                             struct MicroimpactCompliantScene *scene,
                                             struct MicroimpactError *error);

// Simulates impacts with compliance along the surface, as microimpact_simulate does without. microimpact_wall_after and
// microimpact_pair_after take the restitution and the tangential velocity of the results. For microimpact_pair_incidence, initialise
// the contact of the scene with the radius and the density of the reduced sphere.
//
// # Safety
// Each pointer is null or points to what its type says, the motions to `count` of them and the results to room for
// `capacity`, and nobody else uses them during the call.
MicroimpactStatus microimpact_simulate_compliant(const struct MicroimpactCompliantScene *scene,
                                                 const struct MicroimpactMotion *motions,
                                                 size_t count,
                                                 struct MicroimpactCompliantContact *results,
                                                 size_t capacity,
                                                 size_t *written,
                                                 struct MicroimpactError *error);

// Simulates one impact, and writes its trajectory into a buffer with room for `capacity` samples, in the order of time, and how
// many there are: at most as many as there is room for, and never more than MICROIMPACT_LARGEST_TRAJECTORY. In less room,
// samples are left out evenly over time; first touch, peak, beginning of rolling and end are always there. In less than
// MICROIMPACT_SMALLEST_TRAJECTORY there is no trajectory. Where this fails, there are no samples and no result. The error may
// be null.
//
// # Safety
// Each pointer is null or points to what its type says, the samples to room for `capacity` of them, and nobody else uses them
// during the call.
MicroimpactStatus microimpact_simulate_trajectory(const struct MicroimpactContactScene *scene,
                                                  const struct MicroimpactMotion *motion,
                                                  struct MicroimpactSample *samples,
                                                  size_t capacity,
                                                  size_t *written,
                                                  struct MicroimpactContact *result,
                                                  struct MicroimpactError *error);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* MICROIMPACT_H */
