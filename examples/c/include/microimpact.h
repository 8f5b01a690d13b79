/* microimpact for C: impacts of microspheres. Made by cbindgen from examples/c/src; all units SI, all numbers float.
   Instructions and stack are the most over the grid of motions that README names. */

#ifndef MICROIMPACT_H
#define MICROIMPACT_H

#include <stddef.h>
#include <stdint.h>

/* Folds the size of a type into a number, as microimpact_layout does. */
#define MICROIMPACT_FOLD(number, size) ((uint32_t)((number) * 31u + (uint32_t)(size)))
#define MICROIMPACT_LAYOUT_0 \
    MICROIMPACT_FOLD(MICROIMPACT_FOLD(MICROIMPACT_FOLD(MICROIMPACT_FOLD(0u, sizeof(MicroimpactError)), sizeof(MicroimpactClass)), sizeof(MicroimpactMotion)), sizeof(MicroimpactRigidScene))
#define MICROIMPACT_LAYOUT_1 \
    MICROIMPACT_FOLD(MICROIMPACT_FOLD(MICROIMPACT_FOLD(MICROIMPACT_FOLD(MICROIMPACT_LAYOUT_0, sizeof(MicroimpactClassification)), sizeof(MicroimpactContactScene)), sizeof(MicroimpactContact)), sizeof(MicroimpactSample))
#define MICROIMPACT_LAYOUT_2 \
    MICROIMPACT_FOLD(MICROIMPACT_FOLD(MICROIMPACT_FOLD(MICROIMPACT_FOLD(MICROIMPACT_LAYOUT_1, sizeof(MicroimpactCompliantScene)), sizeof(MicroimpactCompliantContact)), sizeof(MicroimpactWall)), sizeof(MicroimpactSpatialMotion))
#define MICROIMPACT_LAYOUT_3 \
    MICROIMPACT_FOLD(MICROIMPACT_FOLD(MICROIMPACT_FOLD(MICROIMPACT_FOLD(MICROIMPACT_LAYOUT_2, sizeof(MicroimpactPair)), sizeof(MicroimpactBoundaryTable)), sizeof(MicroimpactRestitutionTable)), sizeof(MicroimpactTableReading))
#define MICROIMPACT_LAYOUT_4 \
    MICROIMPACT_FOLD(MICROIMPACT_FOLD(MICROIMPACT_FOLD(MICROIMPACT_FOLD(MICROIMPACT_LAYOUT_3, sizeof(MicroimpactSceneConfig)), sizeof(MicroimpactSceneImpact)), sizeof(MicroimpactEvent)), sizeof(MicroimpactQueue))
#define MICROIMPACT_LAYOUT_5 \
    MICROIMPACT_FOLD(MICROIMPACT_FOLD(MICROIMPACT_FOLD(MICROIMPACT_FOLD(MICROIMPACT_LAYOUT_4, sizeof(MicroimpactTally)), sizeof(MicroimpactTallyReport)), sizeof(MicroimpactFixedBody) + sizeof(MicroimpactFixedMotion)), sizeof(MicroimpactFixedResult) + sizeof(MicroimpactFixedContact) + sizeof(MicroimpactFixedImpact))
/* To be compared with what microimpact_layout returns. */
#define MICROIMPACT_LAYOUT \
    MICROIMPACT_FOLD(MICROIMPACT_FOLD(MICROIMPACT_FOLD(MICROIMPACT_FOLD(MICROIMPACT_LAYOUT_5, sizeof(MicroimpactUncertainMotion) + sizeof(MicroimpactUncertainClass)), sizeof(MicroimpactMeasuredImpact) + sizeof(MicroimpactFitRoom)), sizeof(MicroimpactFit)), sizeof(MicroimpactBoundaryMaker) + sizeof(MicroimpactRestitutionMaker) + sizeof(MicroimpactCriticalSearch))


/* Number of the interface: another one has other functions, structures or meanings. */
#define MICROIMPACT_ABI 2

/* Version of the library: major times 10000, minor times 100, patch. */
#define MICROIMPACT_VERSION 100

/* Room that is enough for every text of microimpact_describe. */
#define MICROIMPACT_LARGEST_TEXT 160

/* One unit in the numbers of MicroimpactFixedMotion and MicroimpactFixedResult: 2^24. */
#define MICROIMPACT_FIXED_ONE (1 << 24)

/* Most events that a queue has room for: places go round at twice as many. */
#define MICROIMPACT_LARGEST_QUEUE 1073741824

/* Number of bins of speed of a tally. */
#define MICROIMPACT_TALLY_BINS 8

/* Number of bins with that of faster impacts. */
#define MICROIMPACT_TALLY_RANGES 9

/* Number of classes. */
#define MICROIMPACT_CLASSES 6

/* Least room for a trajectory: first touch, peak, beginning of rolling and end. */
#define MICROIMPACT_SMALLEST_TRAJECTORY 4

/* Room that is always enough: no trajectory has more samples. */
#define MICROIMPACT_LARGEST_TRAJECTORY 64

/* How a function has ended. */
enum {
  /* All is well, and the results are there. */
  MICROIMPACT_STATUS_OK,
  /* A pointer that is null or misaligned; there is no result. */
  MICROIMPACT_STATUS_POINTER,
  /* A number outside its range: the error says which. */
  MICROIMPACT_STATUS_INPUT,
  /* The simulation did not come to an end within its budget; nothing was written for this motion. */
  MICROIMPACT_STATUS_UNSOLVED,
  /* Fewer results fit than there are motions, and those that fit were written; or no trajectory fits. */
  MICROIMPACT_STATUS_CAPACITY,
  /* A table, a tally or a scene in integers that was never made. */
  MICROIMPACT_STATUS_UNMADE,
  /*
   A choice, of a model or a term, that there is not; or a method that this function does not take: a scene of `iterations` where a
   tolerance is needed.
   */
  MICROIMPACT_STATUS_CHOICE,
  /* Fewer measurements than a fit needs. */
  MICROIMPACT_STATUS_TOO_FEW,
  /* Measurements that do not determine a parameter. */
  MICROIMPACT_STATUS_UNDETERMINED,
  /* A measurement that no value of a parameter gives. */
  MICROIMPACT_STATUS_CONTRADICTION
};
typedef uint32_t MicroimpactStatus;

/* How a number misses its range. Its number is that of the protocol of instruments, plus one. */
enum {
  /* No fault. */
  MICROIMPACT_FAULT_NONE,
  /* NaN or infinite. */
  MICROIMPACT_FAULT_NOT_FINITE,
  /* Below the smallest valid value. */
  MICROIMPACT_FAULT_TOO_SMALL,
  /* Above the largest valid value. */
  MICROIMPACT_FAULT_TOO_LARGE,
  /* A thickness above the radius of its sphere. */
  MICROIMPACT_FAULT_EXCEEDS_RADIUS,
  /* A tolerance below the precision of single precision, 1e-6. */
  MICROIMPACT_FAULT_BELOW_PRECISION,
  /* A tolerance below what the nodes of the method can keep. */
  MICROIMPACT_FAULT_TOO_FEW_NODES,
  /* A term that does not go with the others of the scene. */
  MICROIMPACT_FAULT_OTHER_LAW,
  /* A value that does not rise from point to point. */
  MICROIMPACT_FAULT_OUT_OF_ORDER,
  /* A quantity that acts on one body, where two meet. */
  MICROIMPACT_FAULT_TWO_BODIES,
  /* Bodies that do not approach each other along the normal. */
  MICROIMPACT_FAULT_RECEDING,
  /* An index beyond the end of a table. */
  MICROIMPACT_FAULT_NOT_IN_TABLE,
  /* A standard error above three tenths of the value. */
  MICROIMPACT_FAULT_TOO_UNCERTAIN,
  /* Any other fault. */
  MICROIMPACT_FAULT_OTHER
};
typedef uint32_t MicroimpactFault;

/* What became of the sphere. */
enum {
  /* Leaves the surface while its contact point slips. */
  MICROIMPACT_CLASS_REBOUND_SLIDING,
  /* Leaves the surface rolling. */
  MICROIMPACT_CLASS_REBOUND_ROLLING,
  /* Captured, and slides on. */
  MICROIMPACT_CLASS_CAPTURED_SLIDING,
  /* Captured, and rolls on. */
  MICROIMPACT_CLASS_CAPTURED_ROLLING,
  /* Captured and at rest. */
  MICROIMPACT_CLASS_CAPTURED_RESTING,
  /* Too close to the critical speed to decide. */
  MICROIMPACT_CLASS_UNDECIDED
};
typedef uint32_t MicroimpactClass;

/* What a table says of an impact. */
enum {
  /* The sphere leaves the surface. */
  MICROIMPACT_VERDICT_REBOUND,
  /* The surface holds the sphere. */
  MICROIMPACT_VERDICT_CAPTURE,
  /* The speed is closer to the critical one than the error of the table. */
  MICROIMPACT_VERDICT_TOO_CLOSE_TO_CALL,
  /* The table does not reach there. */
  MICROIMPACT_VERDICT_OUTSIDE_TABLE
};
typedef uint32_t MicroimpactVerdict;

/* The motion along the surface after a rebound. */
enum {
  /* There is no rebound. */
  MICROIMPACT_SURFACE_MOTION_NONE,
  /* The contact point slips. */
  MICROIMPACT_SURFACE_MOTION_SLIDING,
  /* The sphere rolls. */
  MICROIMPACT_SURFACE_MOTION_ROLLING
};
typedef uint32_t MicroimpactSurfaceMotion;

/* The model of a scene. */
enum {
  /* The rigid-body model. */
  MICROIMPACT_MODEL_RIGID_BODY,
  /* The simulation of the contact. */
  MICROIMPACT_MODEL_CONTACT
};
typedef uint32_t MicroimpactModel;

/* Restitution of a rigid body. */
enum {
  /* The same R at every speed. */
  MICROIMPACT_RESTITUTION_LAW_CONSTANT,
  /* R = k/(k + v). */
  MICROIMPACT_RESTITUTION_LAW_SPEED,
  /* R = k^p/(k^p + v^p). */
  MICROIMPACT_RESTITUTION_LAW_POWER,
  /* That of an elastic-plastic sphere (Thornton 1997). */
  MICROIMPACT_RESTITUTION_LAW_ELASTIC_PLASTIC,
  /* That of a viscoelastic sphere. */
  MICROIMPACT_RESTITUTION_LAW_VISCOELASTIC
};
typedef uint32_t MicroimpactRestitutionLaw;

/* Adhesion of a rigid body. */
enum {
  /* None. */
  MICROIMPACT_REBOUND_ADHESION_NONE,
  /* A coefficient rho. */
  MICROIMPACT_REBOUND_ADHESION_COEFFICIENT,
  /* A work, J. */
  MICROIMPACT_REBOUND_ADHESION_WORK,
  /* rho = l^q/(l^q + v^q). */
  MICROIMPACT_REBOUND_ADHESION_SPEED
};
typedef uint32_t MicroimpactReboundAdhesion;

/* Damping of the materials of a contact. */
enum {
  /* None. */
  MICROIMPACT_DAMPING_NONE,
  /* That of Hunt and Crossley. */
  MICROIMPACT_DAMPING_HYSTERETIC,
  /* That of a viscoelastic material. */
  MICROIMPACT_DAMPING_VISCOELASTIC,
  /* That which, without adhesion, leaves the same restitution at every speed. */
  MICROIMPACT_DAMPING_CONSTANT
};
typedef uint32_t MicroimpactDamping;

/* Adhesion of a contact, and where contact ends. */
enum {
  /* None; contact ends at zero indentation. */
  MICROIMPACT_ADHESION_NONE,
  /* None; contact ends where damping cancels the elastic force. */
  MICROIMPACT_ADHESION_WITHOUT_TENSION,
  /* The ring force of Brach and Dunn. */
  MICROIMPACT_ADHESION_RING,
  /* Derjaguin, Muller and Toporov. */
  MICROIMPACT_ADHESION_DMT,
  /* Johnson, Kendall and Roberts; contact ends where it snaps off. */
  MICROIMPACT_ADHESION_JKR_SNAP_OFF,
  /* The same; contact ends at the pull-off force. */
  MICROIMPACT_ADHESION_JKR_PULL_OFF
};
typedef uint32_t MicroimpactAdhesion;

/*
 A scene of either model. The choices, numbers of the enumerations in the comments, say which terms are present; a number of a term
 that was not chosen is not looked at. What is left out is zero.
 */
typedef struct MicroimpactSceneConfig {
  /* Radius of the sphere, m. */
  float radius;
  /* Its mean density, kg/m^3. */
  float density;
  /*
   Squared radius of gyration over squared radius; microimpact_scene_init makes zero that of a solid sphere, 0.4. See
   microimpact_sphere_hollow and microimpact_sphere_coated for others.
   */
  float gyration_ratio;
  /* Friction coefficient; may be zero. */
  float friction;
  /* MicroimpactModel. */
  uint32_t model;
  /* MicroimpactRestitutionLaw, of a rigid body. */
  uint32_t restitution_law;
  /* R of a constant restitution. */
  float restitution;
  /* Speed k of MICROIMPACT_RESTITUTION_LAW_SPEED and POWER, m/s. */
  float restitution_speed;
  /* Power p of MICROIMPACT_RESTITUTION_LAW_POWER. */
  float restitution_power;
  /* Speed of first yield of MICROIMPACT_RESTITUTION_LAW_ELASTIC_PLASTIC, m/s. */
  float yield_speed;
  /* MicroimpactReboundAdhesion, of a rigid body. */
  uint32_t rebound_adhesion;
  /* rho of MICROIMPACT_REBOUND_ADHESION_COEFFICIENT. */
  float adhesion_coefficient;
  /* Work of MICROIMPACT_REBOUND_ADHESION_WORK, J. */
  float work_of_adhesion;
  /* Speed l of MICROIMPACT_REBOUND_ADHESION_SPEED, m/s. */
  float adhesion_speed;
  /* Its power q. */
  float adhesion_power;
  /* Hertz stiffness of a contact, and of MICROIMPACT_RESTITUTION_LAW_VISCOELASTIC, Pa. */
  float stiffness;
  /* Relaxation time of a viscoelastic material, of either model, s. */
  float relaxation_time;
  /* MicroimpactDamping, of a contact. */
  uint32_t damping;
  /* zeta_H of MICROIMPACT_DAMPING_HYSTERETIC. */
  float material_damping;
  /* e of MICROIMPACT_DAMPING_CONSTANT. */
  float nominal_restitution;
  /* MicroimpactAdhesion, of a contact. */
  uint32_t adhesion;
  /* f0 of MICROIMPACT_ADHESION_RING, N/m. */
  float adhesion_strength;
  /* Its zeta_A. */
  float adhesion_damping;
  /* Work of adhesion per area of the laws DMT and JKR, J/m^2. */
  float adhesion_energy;
  /* External force on a contact, N, positive out of the surface. */
  float external_force;
  /* Tolerance of the square of the restitution of a contact; microimpact_scene_init makes zero 1e-6. */
  float tolerance;
  /*
   Iterations of the method of fixed cost, 1 to 40, which then takes the place of the one with a tolerance; zero for the latter.
   Contact has to begin and end at zero indentation: with MICROIMPACT_ADHESION_WITHOUT_TENSION or JKR the status is
   MICROIMPACT_STATUS_CHOICE.
   */
  uint32_t iterations;
} MicroimpactSceneConfig;

/* Room for a search for a critical speed, which microimpact_critical_speed_begin prepares. */
typedef struct MicroimpactCriticalSearch {
  /* What is in it concerns the library alone. */
  size_t words[64];
} MicroimpactCriticalSearch;

/* What was wrong with a number. */
typedef struct MicroimpactError {
  /* Number of the parameter, as in the protocol of instruments, for microimpact_parameter_name. */
  uint32_t parameter;
  /* What is wrong with it. */
  MicroimpactFault fault;
  /* Smallest valid value of the parameter by itself; what other numbers of the scene demand of it, the fault says. */
  double smallest;
  /* Largest valid value. */
  double largest;
  /* The value that was refused. */
  double value;
} MicroimpactError;

/* A motion before the impact. */
typedef struct MicroimpactMotion {
  /* Approach speed, positive, m/s. */
  float approach;
  /* Tangential velocity, m/s. */
  float tangential;
  /* Peripheral velocity, spin times radius, m/s. */
  float peripheral;
} MicroimpactMotion;

/* A reading with the time at which it was taken, the size of the particle and its material. */
typedef struct MicroimpactEvent {
  /* Value of a clock's counter. */
  uint32_t ticks;
  /* Index of the particle's material among the scenes. */
  uint32_t material;
  /* Radius of the particle, m; zero for that of the scene. */
  float radius;
  /* Its motion. */
  struct MicroimpactMotion motion;
} MicroimpactEvent;

/* What became of a sphere of a scene of either model. */
typedef struct MicroimpactSceneImpact {
  /* The class. */
  MicroimpactClass impact_class;
  /* Overall restitution, zero for a capture. */
  float restitution;
  /* Tangential velocity after the impact, m/s. */
  float tangential;
  /* Peripheral velocity after the impact, spin times radius, m/s. */
  float peripheral;
} MicroimpactSceneImpact;

/* A quantity with its standard error. */
typedef struct MicroimpactMeasured {
  /* The value. */
  float value;
  /* Its standard error; zero if it is exact. */
  float standard_error;
} MicroimpactMeasured;

/* A measured impact of one of many spheres of the same material. */
typedef struct MicroimpactMeasuredImpact {
  /* Radius of the sphere, m. */
  float radius;
  /* Its density, kg/m^3. */
  float density;
  /* Approach speed, m/s; the standard error is zero if it is not known. */
  struct MicroimpactMeasured approach;
  /* Rebound speed, m/s, which errors may make negative. Not looked at for a capture. */
  struct MicroimpactMeasured rebound;
  /* Zero for a rebound, anything else for a capture. */
  uint32_t captured;
} MicroimpactMeasuredImpact;

/* Room of the caller for one measured impact, in which microimpact_fit_restitution works. */
typedef struct MicroimpactFitRoom {
  /* What is in it concerns the library alone. */
  uint32_t words[9];
} MicroimpactFitRoom;

/* A value with its interval of 95 %. */
typedef struct MicroimpactInterval {
  /* The value. */
  float value;
  /* Lower end. */
  float low;
  /* Upper end. */
  float high;
} MicroimpactInterval;

/* Restitution law R = k/(k + v) and work of adhesion, fitted to many impacts. */
typedef struct MicroimpactFit {
  /* Speed k, m/s. */
  struct MicroimpactInterval restitution_speed;
  /* Work of adhesion, J. */
  struct MicroimpactInterval work_of_adhesion;
  /* Critical speed of the sphere of median mass, m/s; zeros where the law does not fit. */
  struct MicroimpactInterval critical_speed;
  /* Median mass, kg. */
  float mass;
  /* Natural scatter of the restitution: its standard deviation without the errors of the speeds. */
  float scatter;
  /* Number of rebounds. */
  uint32_t rebounds;
  /* Number of captures. */
  uint32_t captures;
  /* Number of rebounds so far from the curve that they have no weight. */
  uint32_t outliers;
  /*
   One if nothing in these impacts contradicts the law; zero if they show a trend over speed that it does not have, or contradict
   the critical speed. Few impacts, or a narrow range of speeds, contradict little.
   */
  uint32_t fits;
} MicroimpactFit;

/* A contact with Hertz's force, adhesion of one kind, damping of one kind, and friction. Zero leaves a term out. */
typedef struct MicroimpactContactScene {
  /* Radius of the sphere, m. */
  float radius;
  /* Its density, kg/m^3. */
  float density;
  /* Hertz stiffness, Pa. */
  float stiffness;
  /*
   Strength zeta_H of hysteretic damping in the materials; may be zero. A damping constant c in s/m of the elastic force times
   1 + c v is zeta_H (m/(r^3 K sqrt(v)))^(2/5), with mass m, radius r, stiffness K and approach speed v.
   */
  float material_damping;
  /* Strength of the ring of adhesion, N/m; may be zero. */
  float adhesion_strength;
  /* Strength of the damping of adhesion; may be zero. */
  float adhesion_damping;
  /* Friction coefficient; may be zero. */
  float friction;
  /* Tolerance of the square of the restitution; microimpact_contact_init fills in 1e-6. */
  float tolerance;
  /* Work of adhesion by Derjaguin, Muller and Toporov, J/m^2; may be zero. */
  float dmt_work;
  /* Work of adhesion by Johnson, Kendall and Roberts, J/m^2; may be zero. */
  float jkr_work;
  /* Relaxation time of viscoelastic damping, s; may be zero. */
  float relaxation_time;
  /* Restitution that constant damping leaves without adhesion, 0.001 to 1; zero leaves the damping out. */
  float nominal_restitution;
  /*
   Zero for an end of contact at zero indentation, or where a JKR contact snaps off. Anything else for an end where damping
   cancels the elastic force, or at the pull-off force of a JKR contact; the ring and DMT have no such end.
   */
  uint32_t ends_by_force;
} MicroimpactContactScene;

/* Room for a contact in integers, which microimpact_fixed_contact_init makes. */
typedef struct MicroimpactFixedContact {
  /* What is in it concerns the library alone. */
  uint32_t words[10];
} MicroimpactFixedContact;

/* A motion before the impact in 2^-24 of the unit of speed: the approach speed from 0.004 to 8 units, the others up to 8. */
typedef struct MicroimpactFixedMotion {
  /* Approach speed, positive. */
  int32_t approach;
  /* Tangential velocity. */
  int32_t tangential;
  /* Peripheral velocity, spin times radius. */
  int32_t peripheral;
} MicroimpactFixedMotion;

/* What became of a sphere, and its velocities after the impact, in 2^-24. */
typedef struct MicroimpactFixedImpact {
  /* What became of the sphere. */
  MicroimpactClass impact_class;
  /* Overall restitution, zero for a capture. */
  int32_t restitution;
  /* Tangential velocity after the impact, in the unit of speed. */
  int32_t tangential;
  /* Peripheral velocity after the impact, in the unit of speed. */
  int32_t peripheral;
} MicroimpactFixedImpact;

/* A rigid body with R = k/(k + v), a work of adhesion and friction. Zero leaves a term out. */
typedef struct MicroimpactRigidScene {
  /* Radius of the sphere, m. */
  float radius;
  /* Its density, kg/m^3. */
  float density;
  /* Speed k of the restitution law, m/s. */
  float restitution_speed;
  /* Work of adhesion, J; may be zero. */
  float work_of_adhesion;
  /* Friction coefficient; may be zero. */
  float friction;
} MicroimpactRigidScene;

/* Room for a rigid body in integers, which microimpact_fixed_init makes. */
typedef struct MicroimpactFixedBody {
  /* What is in it concerns the library alone. */
  uint32_t words[8];
} MicroimpactFixedBody;

/* A class, and what goes with it, in 2^-24. A margin that does not exist is negative. */
typedef struct MicroimpactFixedResult {
  /* What became of the sphere. */
  MicroimpactClass impact_class;
  /* Approach speed over the critical speed; 128 at most. */
  int32_t speed_over_critical;
  /* Friction over the least that ends sliding; 128 at most. */
  int32_t friction_over_limit;
  /* Overall restitution, zero for a capture. */
  int32_t restitution;
  /* Tangential velocity after the impact, in the unit of speed. */
  int32_t tangential;
  /* Peripheral velocity after the impact, in the unit of speed. */
  int32_t peripheral;
} MicroimpactFixedResult;

/* A motion before the impact and a radius, with independent standard errors. */
typedef struct MicroimpactUncertainMotion {
  /* Approach speed, m/s. */
  struct MicroimpactMeasured approach;
  /* Tangential velocity, m/s. */
  struct MicroimpactMeasured tangential;
  /* Peripheral velocity, m/s. */
  struct MicroimpactMeasured peripheral;
  /* Radius of the particle, m. */
  struct MicroimpactMeasured radius;
} MicroimpactUncertainMotion;

/* Probabilities of the classes. */
typedef struct MicroimpactUncertainClass {
  /* The class whose probability reaches the confidence, or MICROIMPACT_CLASS_UNDECIDED. */
  MicroimpactClass impact_class;
  /* Probability of each class, in the order of MicroimpactClass. A sphere that may rest counts as rolling. */
  float probabilities[MICROIMPACT_CLASSES];
} MicroimpactUncertainClass;

/*
 A queue of events with one sender, which may be an interrupt, and one receiver, which may be the main loop. Neither waits for the
 other. Its memory is the caller's; only the functions of the queue may touch it once it is made.
 */
typedef struct MicroimpactQueue {
  /* Room of the caller for events. */
  struct MicroimpactEvent *events;
  /* Number of events that there is room for. */
  uint32_t capacity;
  /* Place of the oldest event, below twice the capacity. The receiver alone writes it. */
  uint32_t first;
  /* Place behind the youngest event, below twice the capacity. The sender alone writes it. */
  uint32_t end;
  /* Events that found the queue full. The sender alone writes it; it saturates. */
  uint32_t lost;
} MicroimpactQueue;

/* The class of an impact, and what goes with it. A margin that does not exist is negative. */
typedef struct MicroimpactClassification {
  /* What became of the sphere. */
  MicroimpactClass impact_class;
  /* Approach speed over the critical speed. */
  float speed_over_critical;
  /* Friction over the least that ends sliding. */
  float friction_over_limit;
  /* Overall restitution, zero for a capture. */
  float restitution;
  /* Tangential velocity after the impact, m/s. */
  float tangential;
  /* Peripheral velocity after the impact, m/s. */
  float peripheral;
} MicroimpactClassification;

/* A simulated impact. An indentation that does not exist is negative. */
typedef struct MicroimpactContact {
  /* What became of the sphere. */
  MicroimpactClass impact_class;
  /* Overall restitution, zero for a capture. */
  float restitution;
  /* Peak indentation, m. */
  float peak_indentation;
  /* Tangential velocity after the contact, m/s. */
  float tangential;
  /* Spin after the contact, rad/s. */
  float spin;
} MicroimpactContact;

/* The wall that a sphere hits, at rest or moving. */
typedef struct MicroimpactWall {
  /* Direction from the wall to the sphere, a vector of length one; within 1e-3 of it, the length is set to one. */
  float normal[3];
  /* Velocity of the surface of the wall at the contact, m/s; zeros for a wall at rest. */
  float velocity[3];
} MicroimpactWall;

/* The motion of a solid sphere in space. */
typedef struct MicroimpactSpatialMotion {
  /* Velocity of the centre, m/s. */
  float velocity[3];
  /* Spin, rad/s. */
  float spin[3];
} MicroimpactSpatialMotion;

/* Two solid spheres that collide. */
typedef struct MicroimpactPair {
  /* Radius of each sphere, m. */
  float radius[2];
  /* Density of each sphere, kg/m^3. */
  float density[2];
  /*
   Direction from the centre of the second sphere to that of the first, a vector of length one; within 1e-3 of it, the
   length is set to one.
   */
  float normal[3];
  /* Motion of each sphere before the impact. */
  struct MicroimpactSpatialMotion motion[2];
} MicroimpactPair;

/* Room for a boundary table that is being made, which microimpact_boundary_begin prepares. */
typedef struct MicroimpactBoundaryMaker {
  /* What is in it concerns the library alone. */
  size_t words[32];
} MicroimpactBoundaryMaker;

/*
 The critical speeds of spheres of one material on one surface, over a range of radii. Made by microimpact_boundary_make,
 or a constant that `cargo microimpact table` has written.
 */
typedef struct MicroimpactBoundaryTable {
  /* Radius at which the table begins, m. */
  float smallest_radius;
  /* Greatest error of the logarithm of a critical speed, in 2^-23 octaves. */
  uint32_t margin;
  /* Cells, in flash or in memory of the caller: a quarter of an octave of radii each. */
  const int32_t (*cells)[4];
  /* Their number. */
  size_t count;
} MicroimpactBoundaryTable;

/* Room for a restitution table that is being made, which microimpact_restitution_begin prepares. */
typedef struct MicroimpactRestitutionMaker {
  /* What is in it concerns the library alone. */
  size_t words[216];
} MicroimpactRestitutionMaker;

/* Room for a table of restitution over two octaves of radii and a range of speeds, which microimpact_restitution_make makes. */
typedef struct MicroimpactRestitutionTable {
  /* What is in it concerns the library alone. */
  uint32_t words[165];
} MicroimpactRestitutionTable;

/* What a restitution table says of an impact. */
typedef struct MicroimpactTableReading {
  /* Rebound or capture. */
  MicroimpactVerdict verdict;
  /* Sliding or rolling. */
  MicroimpactSurfaceMotion surface_motion;
  /* Overall restitution; zero for a capture, negative where the table has no answer. */
  float restitution;
  /* Greatest error of the restitution; zero for a capture, negative where the table has no answer. */
  float restitution_error;
  /* Tangential velocity after a rebound, m/s; else zero. */
  float tangential;
  /* Peripheral velocity after a rebound, m/s; else zero. */
  float peripheral;
} MicroimpactTableReading;

/* Room for a tally, which microimpact_tally_init makes. */
typedef struct MicroimpactTally {
  /* What is in it concerns the library alone. */
  uint64_t words[41];
} MicroimpactTally;

/* What a tally has counted. */
typedef struct MicroimpactTallyReport {
  /* Impacts of each class, in the order of MicroimpactClass. */
  uint64_t classes[MICROIMPACT_CLASSES];
  /* Readings with a number outside its range. */
  uint64_t refused;
  /* Motions that the method did not solve. */
  uint64_t unsolved;
  /* Rebounds in each bin of speed; the last number is of those beyond the last bin. */
  uint64_t rebounds[MICROIMPACT_TALLY_RANGES];
  /* Mean of their overall restitution; zero without rebounds. */
  float mean[MICROIMPACT_TALLY_RANGES];
  /* Variance of it; negative with fewer than two rebounds. */
  float variance[MICROIMPACT_TALLY_RANGES];
  /* Upper edges of the bins of speed, m/s; a speed equal to an edge counts in the bin above it. */
  float edges[MICROIMPACT_TALLY_BINS];
} MicroimpactTallyReport;

/*
 A contact that gives sideways before it slips: one elastic element between sphere and surface sticks until friction is exhausted
 (Mindlin 1949; Thornton, Cummins and Cleary 2011).
 */
typedef struct MicroimpactCompliantScene {
  /*
   The contact: Hertz's force with material_damping and friction, any of which may be zero. All that belongs to another law,
   adhesion, other damping and ends_by_force, must be zero.
   */
  struct MicroimpactContactScene contact;
  /*
   Stiffness ratio chi, 0.001 to 1000: the stiffness along the surface over (3/2) K a, with the Hertz stiffness K and the contact
   radius a. It is 2 (1 - nu)/(2 - nu) for two materials with the same Poisson's ratio nu.
   */
  float stiffness_ratio;
  /*
   How the force along the surface changes while the contact shrinks. Zero: it falls with the stiffness, so that no energy is
   created. Anything else: it does not, as in many programs for granular flow; this rule creates energy.
   */
  uint32_t incremental_unloading;
} MicroimpactCompliantScene;

/* A simulated impact with compliance along the surface. */
typedef struct MicroimpactCompliantContact {
  /* What became of the sphere. Where friction acts, the contact slips in the end. */
  MicroimpactClass impact_class;
  /* Overall restitution. */
  float restitution;
  /* Peak indentation, m. */
  float peak_indentation;
  /* Tangential velocity after the contact, m/s. */
  float tangential;
  /* Spin after the contact, rad/s. */
  float spin;
  /* Velocity of the contact point after the contact, m/s. */
  float slip;
  /* Tangential over normal impulse, negative against a positive slip. */
  float impulse_ratio;
  /* Number of phases: longest intervals of sticking, or of slip in one direction. */
  uint32_t phases;
} MicroimpactCompliantContact;

/* A moment of a simulated impact. */
typedef struct MicroimpactSample {
  /* Time from first touch, s. */
  float time;
  /* Indentation, m. */
  float indentation;
  /* Its rate, m/s: positive on the way in, negative on the way out, zero at the peak. */
  float velocity;
  /* Normal force of the surface on the sphere, N, positive where it repels. */
  float force;
  /* Its elastic part, N. */
  float elastic;
} MicroimpactSample;

#ifdef __cplusplus
extern "C" {
#endif /* __cplusplus */

/*
 Version of the library; MICROIMPACT_VERSION is that of the header. Re-entrant.
 On a Cortex-M3, at most 4 instructions and 64 bytes of stack.
 */
uint32_t microimpact_version(void);

/*
 Number of the library's interface, to be compared with MICROIMPACT_ABI of the header. Re-entrant.
 On a Cortex-M3, at most 4 instructions and 64 bytes of stack.
 */
uint32_t microimpact_abi(void);

/*
 A number made of the sizes of all structures, to be compared with MICROIMPACT_LAYOUT, which the caller's compiler makes of the
 same: they differ where an option of the compiler changes the size of a structure. Re-entrant.
 On a Cortex-M3, at most 5 instructions and 64 bytes of stack.
 */
uint32_t microimpact_layout(void);

/*
 Begins the search for the speed that microimpact_scene_critical_speed writes. The scene is copied; a contact needs a tolerance, not
 iterations. Nothing is computed as yet. The error may be null. Re-entrant.
 On a Cortex-M3, at most 1409 instructions and 872 bytes of stack.

 # Safety
 Each pointer is null or points to what its type says, and nobody else uses it during the call.
 */
MicroimpactStatus microimpact_critical_speed_begin(const struct MicroimpactSceneConfig *scene,
                                                   struct MicroimpactCriticalSearch *search,
                                                   struct MicroimpactError *error);

/*
 Goes on with a search by at most `budget` trials of a speed, of which it takes less than ten as a rule and never more than 88, and
 writes 1 to `found` once the speed is found, else 0. The speed is written where it is found: the one of
 microimpact_scene_critical_speed to the last bit. That of a rigid body needs no trial. The figures are those of one trial. Where a
 step fails, so does every further one. The error may be null. Re-entrant.
 On a Cortex-M3, a trial, at most 3443600 instructions and 2192 bytes of stack.

 # Safety
 Each pointer is null or points to what its type says, and nobody else uses it during the call; only
 microimpact_critical_speed_begin and this function have written to the search.
 */
MicroimpactStatus microimpact_critical_speed_step(struct MicroimpactCriticalSearch *search,
                                                  uint32_t budget,
                                                  float *speed,
                                                  uint32_t *found,
                                                  struct MicroimpactError *error);

/*
 Writes the name of a parameter and a zero byte to a buffer, cut off where it is too small, and returns the length of the
 whole name, zero for a parameter that there is not. Re-entrant.
 On a Cortex-M3, at most 888 instructions and 96 bytes of stack.

 # Safety
 The buffer is null or has room for `capacity` bytes.
 */
size_t microimpact_parameter_name(uint32_t parameter,
                                  char *buffer,
                                  size_t capacity);

/*
 The same for the unit of a parameter, "1" for a ratio. Re-entrant.
 On a Cortex-M3, at most 681 instructions and 96 bytes of stack.

 # Safety
 The buffer is null or has room for `capacity` bytes.
 */
size_t microimpact_parameter_unit(uint32_t parameter, char *buffer, size_t capacity);

/*
 Writes an error in words, from its parameter and its fault, and a zero byte to a buffer, as "approach speed (m/s): below the smallest
 valid value", cut off where it is too small, and returns the length of the whole text, zero if there is no error. MICROIMPACT_LARGEST_TEXT bytes are always enough.
 The numbers are in the error: printf("%s: %g, not %g to %g", text, error.value, error.smallest, error.largest). Re-entrant.
 On a Cortex-M3, at most 2130 instructions and 152 bytes of stack.

 # Safety
 The buffer is null or has room for `capacity` bytes.
 */
size_t microimpact_describe(uint32_t parameter,
                            uint32_t fault,
                            char *buffer,
                            size_t capacity);

/*
 What becomes of the particle of an event: the scene at the index of its material, of `count`, with the radius of the event. The
 other numbers of the scene, a work of adhesion too, stay as they are. The error may be null. Re-entrant.
 On a Cortex-M3, rigid body, at most 3428 instructions and 1304 bytes of stack.

 # Safety
 Each pointer is null or points to what its type says, the materials to `count` of them, and nobody else uses it during the call.
 */
MicroimpactStatus microimpact_event_classify(const struct MicroimpactSceneConfig *materials,
                                             size_t count,
                                             const struct MicroimpactEvent *event,
                                             struct MicroimpactSceneImpact *impact,
                                             struct MicroimpactError *error);

/*
 Fits the law to `count` measured impacts, of which at least 12 are rebounds, in room of the caller for as many. The intervals hold the
 truth in 93 to 97 of 100 sets from 30 rebounds on. The time it takes grows with the square of the number. The error may be null.
 Re-entrant, with other room.
 On a Cortex-M3, 30 impacts, at most 49137181 instructions and 1056 bytes of stack.

 # Safety
 Each pointer is null or points to what its type says, the impacts and the room to `count` of them, and nobody else uses it during the
 call.
 */
MicroimpactStatus microimpact_fit_restitution(const struct MicroimpactMeasuredImpact *impacts,
                                              struct MicroimpactFitRoom *room,
                                              size_t count,
                                              struct MicroimpactFit *fit,
                                              struct MicroimpactError *error);

/*
 Writes the strength zeta_H of hysteretic damping with which a scene without adhesion rebounds with a measured restitution at a speed,
 m/s. Of the scene, radius, density, stiffness and tolerance count. The error may be null. Re-entrant.
 On a Cortex-M3, at most 3364940 instructions and 2152 bytes of stack.

 # Safety
 Each pointer is null or points to what its type says, and nobody else uses it during the call.
 */
MicroimpactStatus microimpact_fit_material_damping(const struct MicroimpactContactScene *scene,
                                                   float speed,
                                                   float restitution,
                                                   float *material_damping,
                                                   struct MicroimpactError *error);

/*
 Makes a contact in integers of a scene and a unit of speed, m/s, near the speeds that occur. The scene has hysteretic damping, a ring
 of adhesion and friction, each of which may be zero; another adhesion, damping or end of contact is refused. This takes floating point;
 what it makes can be copied, stored and made on another machine of the same byte order. The error may be null. Re-entrant.
 On a Cortex-M3, at most 10883 instructions and 264 bytes of stack.

 # Safety
 Each pointer is null or points to what its type says, and nobody else uses it during the call.
 */
MicroimpactStatus microimpact_fixed_contact_init(const struct MicroimpactContactScene *scene,
                                                 float unit,
                                                 struct MicroimpactFixedContact *contact,
                                                 struct MicroimpactError *error);

/*
 Simulates an impact in integers alone, by the method of fixed cost with 5 nodes and 3 iterations; the approach speed must be 0.1 to 8
 units. A number that is refused is the exception, of which the error tells in floating point. Damping that is too strong for the method
 is MICROIMPACT_STATUS_UNSOLVED. The error may be null. Re-entrant.
 On a Cortex-M3, at most 21235 instructions and 716 bytes of stack.

 # Safety
 Each pointer is null or points to what its type says, and nobody else uses it during the call.
 */
MicroimpactStatus microimpact_fixed_simulate(const struct MicroimpactFixedContact *contact,
                                             const struct MicroimpactFixedMotion *motion,
                                             struct MicroimpactFixedImpact *impact,
                                             struct MicroimpactError *error);

/*
 Makes a rigid body in integers of a scene and a unit of speed, m/s, near the speeds that occur. This takes floating point; what it
 makes can be copied, stored and made on another machine of the same byte order. The error may be null. Re-entrant.
 On a Cortex-M3, at most 4096 instructions and 296 bytes of stack.

 # Safety
 Each pointer is null or points to what its type says, and nobody else uses it during the call.
 */
MicroimpactStatus microimpact_fixed_init(const struct MicroimpactRigidScene *scene,
                                         float unit,
                                         struct MicroimpactFixedBody *body,
                                         struct MicroimpactError *error);

/*
 Classifies an impact of a rigid body in integers alone; a number that is refused is the exception, of which the error tells in
 floating point. Velocities are exact to 1e-5 units, and to 1e-4 close to the critical speed. The error may be null. Re-entrant.
 On a Cortex-M3, at most 804 instructions and 124 bytes of stack.

 # Safety
 Each pointer is null or points to what its type says, and nobody else uses it during the call.
 */
MicroimpactStatus microimpact_fixed_classify(const struct MicroimpactFixedBody *body,
                                             const struct MicroimpactFixedMotion *motion,
                                             struct MicroimpactFixedResult *result,
                                             struct MicroimpactError *error);

/*
 Probabilities of the classes of an uncertain motion, and the class if one reaches the confidence, 0.5 to 1. The scene is that of
 microimpact_scene_init, whose radius does not count; a contact needs a tolerance, not iterations. A rigid body takes 12 thousand
 instructions in single precision on a Cortex-M4F, and a contact millions. With standard errors of up to 10 % the error of a
 probability is below 0.01, and below 0.04 for few motions that are close to capture and to the limit of slip at once, or
 whose standard errors reach 30 %. Errors above three tenths of the approach speed or of the radius are refused. The error may be null.
 Re-entrant.
 On a Cortex-M3, rigid body, at most 237575 instructions and 3512 bytes of stack.
 On a Cortex-M3, contact, at most 270189689 instructions and 5712 bytes of stack.

 # Safety
 Each pointer is null or points to what its type says, and nobody else uses it during the call.
 */
MicroimpactStatus microimpact_scene_probabilities(const struct MicroimpactSceneConfig *scene,
                                                  const struct MicroimpactUncertainMotion *motion,
                                                  float confidence,
                                                  struct MicroimpactUncertainClass *result,
                                                  struct MicroimpactError *error);

/*
 Makes an empty queue with room for `capacity` events, 1 to MICROIMPACT_LARGEST_QUEUE, in memory of the caller. Else it is
 MICROIMPACT_STATUS_CAPACITY. Not re-entrant: call it before the interrupt is enabled.
 On a Cortex-M3, at most 27 instructions and 64 bytes of stack.

 # Safety
 Each pointer is null or points to what its type says, the events to room for `capacity` of them, for as long as the queue is used.
 */
MicroimpactStatus microimpact_queue_init(struct MicroimpactQueue *queue,
                                         struct MicroimpactEvent *events,
                                         size_t capacity);

/*
 Puts an event into a queue; one that finds it full is counted as lost, and MICROIMPACT_STATUS_CAPACITY. No floating point is used,
 and there is no loop. For an interrupt, while microimpact_queue_pop runs in the main loop; no two senders at once.
 On a Cortex-M3, at most 71 instructions and 64 bytes of stack.

 # Safety
 Each pointer is null or points to what its type says, the queue to one that microimpact_queue_init has made.
 */
MicroimpactStatus microimpact_queue_push(struct MicroimpactQueue *queue,
                                         const struct MicroimpactEvent *event);

/*
 Takes the oldest event from a queue; from an empty one it is MICROIMPACT_STATUS_CAPACITY. For the main loop, while
 microimpact_queue_push runs in an interrupt; no two receivers at once.
 On a Cortex-M3, at most 72 instructions and 64 bytes of stack.

 # Safety
 Each pointer is null or points to what its type says, the queue to one that microimpact_queue_init has made.
 */
MicroimpactStatus microimpact_queue_pop(struct MicroimpactQueue *queue,
                                        struct MicroimpactEvent *event);

/*
 Number of events that found a queue full since it was made; it saturates. Re-entrant.
 On a Cortex-M3, at most 17 instructions and 64 bytes of stack.

 # Safety
 The pointer is null or points to a queue that microimpact_queue_init has made.
 */
uint32_t microimpact_queue_lost(const struct MicroimpactQueue *queue);

/*
 Initialises a scene with parameters, of which what is left out is zero, and checks every one. The error names the first that
 is outside its range, and may be null. Where this fails, the scene holds zeros, which every function reports. The parameters
 and the scene may be the same memory. Re-entrant.
 On a Cortex-M3, at most 1140 instructions and 304 bytes of stack.

 # Safety
 Each pointer is null or points to what its type says, and nobody else uses it during the call.
 */
MicroimpactStatus microimpact_rigid_init(const struct MicroimpactRigidScene *parameters,
                                         struct MicroimpactRigidScene *scene,
                                         struct MicroimpactError *error);

/*
 Classifies an impact of a rigid body. The error may be null. Re-entrant.
 On a Cortex-M3, at most 3332 instructions and 328 bytes of stack.

 # Safety
 Each pointer is null or points to what its type says, and nobody else uses it during the call.
 */
MicroimpactStatus microimpact_classify(const struct MicroimpactRigidScene *scene,
                                       const struct MicroimpactMotion *motion,
                                       struct MicroimpactClassification *result,
                                       struct MicroimpactError *error);

/*
 Initialises a scene with parameters, fills in the gyration ratio and the tolerance if they are zero, and checks every number that the
 chosen terms have. The error names the first that is outside its range, and may be null; an unknown choice is
 MICROIMPACT_STATUS_CHOICE. Where this fails, the scene holds zeros, which every function reports. The parameters and the scene may
 be the same memory. Re-entrant.
 On a Cortex-M3, at most 1803 instructions and 1200 bytes of stack.

 # Safety
 Each pointer is null or points to what its type says, and nobody else uses it during the call.
 */
MicroimpactStatus microimpact_scene_init(const struct MicroimpactSceneConfig *parameters,
                                         struct MicroimpactSceneConfig *scene,
                                         struct MicroimpactError *error);

/*
 What becomes of a sphere of a scene. A contact for which the method does not come to an end, or whose error the method of fixed
 cost cannot bound, is MICROIMPACT_STATUS_UNSOLVED. The error may be null. Re-entrant.
 On a Cortex-M3, rigid body, at most 3387 instructions and 1296 bytes of stack.
 On a Cortex-M3, tolerance, at most 647963 instructions and 2376 bytes of stack.
 On a Cortex-M3, 3 iterations, at most 196870 instructions and 1272 bytes of stack.
 On a Cortex-M3, tolerance on the shared grid, at most 8951261 instructions and 2632 bytes of stack.
 On a Cortex-M3, 3 iterations on the shared grid, at most 197009 instructions and 1272 bytes of stack.

 # Safety
 Each pointer is null or points to what its type says, and nobody else uses it during the call.
 */
MicroimpactStatus microimpact_scene_classify(const struct MicroimpactSceneConfig *scene,
                                             const struct MicroimpactMotion *motion,
                                             struct MicroimpactSceneImpact *impact,
                                             struct MicroimpactError *error);

/*
 Writes the speed below which the surface holds a sphere of a scene, m/s: zero if it never does, a negative number if it always
 does. A contact needs a tolerance, not iterations. microimpact_critical_speed_step finds it in steps. The error may be null. Re-entrant.
 On a Cortex-M3, rigid body, at most 1751 instructions and 800 bytes of stack.
 On a Cortex-M3, contact, at most 27805261 instructions and 2280 bytes of stack.

 # Safety
 Each pointer is null or points to what its type says, and nobody else uses it during the call.
 */
MicroimpactStatus microimpact_scene_critical_speed(const struct MicroimpactSceneConfig *scene,
                                                   float *speed,
                                                   struct MicroimpactError *error);

/*
 Initialises a scene with parameters, of which what is left out is zero, fills in the tolerance if it is, and checks every
 one. The error names the first that is outside its range, and may be null. Where this fails, the scene holds zeros, which
 every function reports. The parameters and the scene may be the same memory. Re-entrant.
 On a Cortex-M3, at most 1125 instructions and 536 bytes of stack.

 # Safety
 Each pointer is null or points to what its type says, and nobody else uses it during the call.
 */
MicroimpactStatus microimpact_contact_init(const struct MicroimpactContactScene *parameters,
                                           struct MicroimpactContactScene *scene,
                                           struct MicroimpactError *error);

/*
 Simulates `count` impacts into a buffer with room for `capacity` results, in the order of the motions, and writes how many
 there are, of those before the first that fails. The error may be null. Re-entrant.
 On a Cortex-M3, at most 647755 instructions and 1936 bytes of stack.
 On a Cortex-M3, the shared grid, at most 8951053 instructions and 2192 bytes of stack.

 # Safety
 Each pointer is null or points to what its type says, the motions to `count` of them and the results to room for
 `capacity`, and nobody else uses them during the call.
 */
MicroimpactStatus microimpact_simulate(const struct MicroimpactContactScene *scene,
                                       const struct MicroimpactMotion *motions,
                                       size_t count,
                                       struct MicroimpactContact *results,
                                       size_t capacity,
                                       size_t *written,
                                       struct MicroimpactError *error);

/*
 Simulates as microimpact_simulate, each impact in at most so many intervals of its motion, refused ones included: a bound of its time,
 since an interval takes at most 350 evaluations of the forces. An impact that needs more is MICROIMPACT_STATUS_UNSOLVED, or
 undecided where no more than that can be told; any other result is that of microimpact_simulate to the last bit. That function allows
 320 intervals, and so does a larger number here. The error may be null. Re-entrant.
 On a Cortex-M3, 12 intervals on the shared grid, at most 4160281 instructions and 2200 bytes of stack.

 # Safety
 As for [`microimpact_simulate`].
 */
MicroimpactStatus microimpact_simulate_within(const struct MicroimpactContactScene *scene,
                                              uint32_t intervals,
                                              const struct MicroimpactMotion *motions,
                                              size_t count,
                                              struct MicroimpactContact *results,
                                              size_t capacity,
                                              size_t *written,
                                              struct MicroimpactError *error);

/*
 Computes the planar motion of a solid sphere of the given radius (m) that hits a wall. microimpact_classify and
 microimpact_simulate take it, with a scene of the same radius.

 The plane contains the normal and the velocity with which the contact point slips on the wall. The sphere keeps its velocity
 across that plane (microimpact_wall_sideways), so that a class such as rolling or resting describes the motion in the plane.

 It is an error with the fault MICROIMPACT_FAULT_RECEDING if the sphere does not approach the wall. Where this fails, nothing
 is written but the error, which may be null. Re-entrant.
 On a Cortex-M3, at most 9742 instructions and 712 bytes of stack.

 # Safety
 Each pointer is null or points to what its type says, and nobody else uses it during the call.
 */
MicroimpactStatus microimpact_wall_incidence(const struct MicroimpactWall *wall,
                                             float radius,
                                             const struct MicroimpactSpatialMotion *motion,
                                             struct MicroimpactMotion *planar,
                                             struct MicroimpactError *error);

/*
 Computes the velocity of a solid sphere across the plane of its impact on a wall (m/s), seen from the wall: from what
 microimpact_wall_incidence takes. The sphere keeps it. So a sphere of MICROIMPACT_CLASS_CAPTURED_RESTING rests only if this
 velocity is zero, and else rolls sideways with it. Where this fails, nothing is written but the error, which may be null.
 Re-entrant.
 On a Cortex-M3, at most 9741 instructions and 712 bytes of stack.

 # Safety
 Each pointer is null or points to what its type says, and nobody else uses it during the call.
 */
MicroimpactStatus microimpact_wall_sideways(const struct MicroimpactWall *wall,
                                            float radius,
                                            const struct MicroimpactSpatialMotion *motion,
                                            float *sideways,
                                            struct MicroimpactError *error);

/*
 Computes the motion in space of a solid sphere after its impact on a wall: from the wall, the radius (m) and the motion that
 microimpact_wall_incidence took, and from the overall restitution (0 to 1) and the tangential velocity (m/s) that
 microimpact_classify, microimpact_simulate or microimpact_simulate_compliant returned for its planar motion.

 With a restitution of zero, the sphere stays on the wall. An impact of MICROIMPACT_CLASS_UNDECIDED has that restitution, too,
 but the motion after it is not known: do not call this function for it.

 The motions before and after may be the same memory. Where this fails, nothing is written but the error, which may be null.
 Re-entrant.
 On a Cortex-M3, at most 11141 instructions and 776 bytes of stack.

 # Safety
 Each pointer is null or points to what its type says, and nobody else uses it during the call.
 */
MicroimpactStatus microimpact_wall_after(const struct MicroimpactWall *wall,
                                         float radius,
                                         const struct MicroimpactSpatialMotion *motion,
                                         float restitution,
                                         float tangential,
                                         struct MicroimpactSpatialMotion *after,
                                         struct MicroimpactError *error);

/*
 Computes the reduced sphere of two solid spheres that collide, whose impact on a wall is equivalent to the collision: its
 radius (m), its density (kg/m^3) and its planar motion. Initialise a scene with this radius and this density;
 microimpact_classify, microimpact_simulate and microimpact_simulate_compliant then take the planar motion. All other parameters of the scene are those of the
 contact of the two spheres, and a work of adhesion in joules is that of the relative motion.

 The tangential velocity is that with which the spheres slip on each other, and the peripheral velocity is zero.

 It is an error with the fault MICROIMPACT_FAULT_RECEDING if the spheres do not approach each other. Where this fails, nothing
 is written but the error, which may be null. Re-entrant.
 On a Cortex-M3, at most 10124 instructions and 888 bytes of stack.

 # Safety
 Each pointer is null or points to what its type says, and nobody else uses it during the call.
 */
MicroimpactStatus microimpact_pair_incidence(const struct MicroimpactPair *pair,
                                             float *radius,
                                             float *density,
                                             struct MicroimpactMotion *planar,
                                             struct MicroimpactError *error);

/*
 Computes the motions in space of two solid spheres after their collision: from the pair that microimpact_pair_incidence took,
 and from the overall restitution (0 to 1) and the tangential velocity (m/s) that microimpact_classify, microimpact_simulate or
 microimpact_simulate_compliant returned for its planar motion. There is room for two motions, those of the first and of the second sphere.

 With a restitution of zero, the spheres stay in contact. An impact of MICROIMPACT_CLASS_UNDECIDED has that restitution, too, but
 the motions after it are not known: do not call this function for it.

 The motions after the impact may be in the memory of those of the pair. Where this fails, nothing is written but the error,
 which may be null. Re-entrant.
 On a Cortex-M3, at most 12298 instructions and 992 bytes of stack.

 # Safety
 Each pointer is null or points to what its type says, the motions to room for two of them, and nobody else uses them during
 the call.
 */
MicroimpactStatus microimpact_pair_after(const struct MicroimpactPair *pair,
                                         float restitution,
                                         float tangential,
                                         struct MicroimpactSpatialMotion *after,
                                         struct MicroimpactError *error);

/*
 Writes radius, mean density and gyration ratio of a hollow sphere into a scene, with the radius (m), the thickness of its wall (m) and
 the density of the wall (kg/m^3). Everything else of the scene stays as it is. The error may be null. Re-entrant.
 On a Cortex-M3, at most 1872 instructions and 272 bytes of stack.

 # Safety
 Each pointer is null or points to what its type says, and nobody else uses it during the call.
 */
MicroimpactStatus microimpact_sphere_hollow(float radius,
                                            float thickness,
                                            float density,
                                            struct MicroimpactSceneConfig *scene,
                                            struct MicroimpactError *error);

/*
 The same for a coated sphere, with the radius (m), the thickness of the coating (m) and the densities of core and coating (kg/m^3).
 Re-entrant.
 On a Cortex-M3, at most 2047 instructions and 280 bytes of stack.

 # Safety
 Each pointer is null or points to what its type says, and nobody else uses it during the call.
 */
MicroimpactStatus microimpact_sphere_coated(float radius,
                                            float thickness,
                                            float core_density,
                                            float coating_density,
                                            struct MicroimpactSceneConfig *scene,
                                            struct MicroimpactError *error);

/*
 Begins a boundary table as microimpact_boundary_make makes it, in cells of the caller, which the maker keeps pointing to: until the
 table is complete, they belong to it. The scene is copied. Nothing is computed as yet. The error may be null. Re-entrant.
 On a Cortex-M3, 12 cells, at most 1260 instructions and 496 bytes of stack.

 # Safety
 Each pointer is null or points to what its type says, the cells to room for `count` of them, and nobody else uses them
 during the call.
 */
MicroimpactStatus microimpact_boundary_begin(const struct MicroimpactContactScene *scene,
                                             float smallest_radius,
                                             int32_t (*cells)[4],
                                             size_t count,
                                             struct MicroimpactBoundaryMaker *maker,
                                             struct MicroimpactError *error);

/*
 Goes on with a boundary table by at most `budget` critical speeds, of which a table takes seven for each cell, and writes how many
 remain. Where none remains, the table is written: the one of microimpact_boundary_make to the last bit. A critical speed is the
 least that a step computes; the figures are those of one. Where a step fails, the next one tries the same critical speed again. The
 error may be null. Re-entrant.
 On a Cortex-M3, a critical speed of 12 cells, at most 29847685 instructions and 2496 bytes of stack.

 # Safety
 Each pointer is null or points to what its type says, and nobody else uses it during the call; so do the cells given to
 microimpact_boundary_begin.
 */
MicroimpactStatus microimpact_boundary_step(struct MicroimpactBoundaryMaker *maker,
                                            size_t budget,
                                            struct MicroimpactBoundaryTable *table,
                                            size_t *remaining,
                                            struct MicroimpactError *error);

/*
 Begins a restitution table as microimpact_restitution_make makes it. The scene is copied. Nothing is computed as yet. The error may be
 null. Re-entrant.
 On a Cortex-M3, at most 1287 instructions and 496 bytes of stack.

 # Safety
 Each pointer is null or points to what its type says, and nobody else uses it during the call.
 */
MicroimpactStatus microimpact_restitution_begin(const struct MicroimpactContactScene *scene,
                                                float smallest_radius,
                                                float speed_ratio,
                                                struct MicroimpactRestitutionMaker *maker,
                                                struct MicroimpactError *error);

/*
 Goes on with a restitution table by at most `budget` critical speeds or simulations, of which the table takes 56 and then 336, and
 writes how many remain. Where none remains, the table is written: the one of microimpact_restitution_make to the last bit. One critical speed or
 one simulation is the least that a step computes; the figures are those of a critical speed. Where a step fails, the next one tries
 the same again. The error may be null. Re-entrant.
 On a Cortex-M3, a critical speed or a simulation, at most 29847669 instructions and 3704 bytes of stack.

 # Safety
 Each pointer is null or points to what its type says, and nobody else uses it during the call.
 */
MicroimpactStatus microimpact_restitution_step(struct MicroimpactRestitutionMaker *maker,
                                               size_t budget,
                                               struct MicroimpactRestitutionTable *table,
                                               size_t *remaining,
                                               struct MicroimpactError *error);

/*
 Makes a boundary table of the material and the surface of a scene, whose radius and friction do not count, from a radius on
 (m), in cells of the caller, which the table keeps pointing to. Where it fails, the cells hold no table. It takes seven critical
 speeds for each cell; microimpact_boundary_step makes as many of them as you allow. The error may be null. Re-entrant.
 On a Cortex-M3, 12 cells, at most 1168655393 instructions and 2488 bytes of stack.

 # Safety
 Each pointer is null or points to what its type says, the cells to room for `count` of them, and nobody else uses them
 during the call.
 */
MicroimpactStatus microimpact_boundary_make(const struct MicroimpactContactScene *scene,
                                            float smallest_radius,
                                            int32_t (*cells)[4],
                                            size_t count,
                                            struct MicroimpactBoundaryTable *table,
                                            struct MicroimpactError *error);

/*
 Checks all of a boundary table: a constant once, at start-up. The error may be null. Re-entrant.
 On a Cortex-M3, 12 cells, at most 1579 instructions and 120 bytes of stack.

 # Safety
 Each pointer is null or points to what its type says, and nobody else uses it during the call; so do the cells.
 */
MicroimpactStatus microimpact_boundary_check(const struct MicroimpactBoundaryTable *table,
                                             struct MicroimpactError *error);

/*
 Tells rebound from capture of a sphere of a radius (m). Of the table, the cell around that radius is checked. The error may
 be null. Re-entrant.
 On a Cortex-M3, at most 552 instructions and 224 bytes of stack.

 # Safety
 Each pointer is null or points to what its type says, and nobody else uses it during the call; so do the cells.
 */
MicroimpactStatus microimpact_boundary_classify(const struct MicroimpactBoundaryTable *table,
                                                float radius,
                                                const struct MicroimpactMotion *motion,
                                                MicroimpactVerdict *verdict,
                                                struct MicroimpactError *error);

/*
 Makes a restitution table of the material, the surface and the friction of a scene, whose radius does not count: over two
 octaves of radii from one on (m), and up to `speed_ratio` times the critical speed. If it fails, the room keeps what it held. It
 takes hundreds of simulations; microimpact_restitution_step makes as many of them as you allow. The error may be null.
 Re-entrant.
 On a Cortex-M3, at most 997842866 instructions and 3912 bytes of stack.

 # Safety
 Each pointer is null or points to what its type says, and nobody else uses it during the call.
 */
MicroimpactStatus microimpact_restitution_make(const struct MicroimpactContactScene *scene,
                                               float smallest_radius,
                                               float speed_ratio,
                                               struct MicroimpactRestitutionTable *table,
                                               struct MicroimpactError *error);

/*
 Reads from a table what becomes of a sphere of a radius (m). The error may be null. Re-entrant.
 On a Cortex-M3, at most 7014 instructions and 232 bytes of stack.

 # Safety
 Each pointer is null or points to what its type says, and nobody else uses it during the call.
 */
MicroimpactStatus microimpact_restitution_read(const struct MicroimpactRestitutionTable *table,
                                               float radius,
                                               const struct MicroimpactMotion *motion,
                                               struct MicroimpactTableReading *reading,
                                               struct MicroimpactError *error);

/*
 Makes an empty tally with the upper edges of eight bins of speed, m/s, which rise. If they are refused, the tally
 stays as it was. The error may be null. Re-entrant.
 On a Cortex-M3, at most 884 instructions and 108 bytes of stack.

 # Safety
 Each pointer is null or points to what its type says, the edges to eight, and nobody else uses it during the call.
 */
MicroimpactStatus microimpact_tally_init(struct MicroimpactTally *tally,
                                         const float *edges,
                                         struct MicroimpactError *error);

/*
 Counts an impact, by how it was classified: `status` is what that function has returned, and the impact counts if it is
 MICROIMPACT_STATUS_OK. MICROIMPACT_STATUS_INPUT counts as refused, any other status as unsolved; the impact may then be null. An impact with a speed or
 a restitution that is none is not counted, and gives MICROIMPACT_STATUS_INPUT. Not re-entrant: a tally belongs to the main loop, or to one interrupt.
 On a Cortex-M3, at most 1891 instructions and 412 bytes of stack.

 # Safety
 Each pointer is null or points to what its type says, and nobody else uses it during the call.
 */
MicroimpactStatus microimpact_tally_record(struct MicroimpactTally *tally,
                                           float approach,
                                           uint32_t status,
                                           const struct MicroimpactSceneImpact *impact);

/*
 Writes what a tally has counted. Not re-entrant with microimpact_tally_record of the same tally.
 On a Cortex-M3, at most 829 instructions and 304 bytes of stack.

 # Safety
 Each pointer is null or points to what its type says, and nobody else uses it during the call.
 */
MicroimpactStatus microimpact_tally_read(const struct MicroimpactTally *tally,
                                         struct MicroimpactTallyReport *report);

/*
 Initialises a scene as microimpact_contact_init does, with the tolerance of its contact. If another law of contact is asked for, the
 error names the stiffness ratio with the fault MICROIMPACT_FAULT_OTHER_LAW. Re-entrant.
 On a Cortex-M3, at most 2130 instructions and 744 bytes of stack.

 # Safety
 Each pointer is null or points to what its type says, and nobody else uses it during the call.
 */
MicroimpactStatus microimpact_compliant_init(const struct MicroimpactCompliantScene *parameters,
                                             struct MicroimpactCompliantScene *scene,
                                             struct MicroimpactError *error);

/*
 Simulates impacts with compliance along the surface, as microimpact_simulate does without. microimpact_wall_after and
 microimpact_pair_after take the restitution and the tangential velocity of the results. For microimpact_pair_incidence, initialise
 the contact of the scene with the radius and the density of the reduced sphere. Re-entrant.
 On a Cortex-M3, at most 35381918 instructions and 2136 bytes of stack.

 # Safety
 Each pointer is null or points to what its type says, the motions to `count` of them and the results to room for
 `capacity`, and nobody else uses them during the call.
 */
MicroimpactStatus microimpact_simulate_compliant(const struct MicroimpactCompliantScene *scene,
                                                 const struct MicroimpactMotion *motions,
                                                 size_t count,
                                                 struct MicroimpactCompliantContact *results,
                                                 size_t capacity,
                                                 size_t *written,
                                                 struct MicroimpactError *error);

/*
 Simulates one impact, and writes its trajectory into a buffer with room for `capacity` samples, in the order of time, and how
 many there are: at most as many as there is room for, and never more than MICROIMPACT_LARGEST_TRAJECTORY. In less room,
 samples are left out evenly over time; first touch, peak, beginning of rolling and end are always there. In less than
 MICROIMPACT_SMALLEST_TRAJECTORY there is no trajectory. Where this fails, there are no samples and no result. The error may
 be null. Re-entrant.
 On a Cortex-M3, at most 1508609 instructions and 10456 bytes of stack.

 # Safety
 Each pointer is null or points to what its type says, the samples to room for `capacity` of them, and nobody else uses them
 during the call.
 */
MicroimpactStatus microimpact_simulate_trajectory(const struct MicroimpactContactScene *scene,
                                                  const struct MicroimpactMotion *motion,
                                                  struct MicroimpactSample *samples,
                                                  size_t capacity,
                                                  size_t *written,
                                                  struct MicroimpactContact *result,
                                                  struct MicroimpactError *error);

#ifdef __cplusplus
}  /* extern "C" */
#endif  /* __cplusplus */

#endif  /* MICROIMPACT_H */
