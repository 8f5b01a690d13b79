#include <stdio.h>

#include "microimpact.h"

int main(void) {
    const MicroimpactRigidScene fitted = {.radius = 5.06e-6f, .density = 2600.0f, .restitution_speed = 129.0f,
                                          .work_of_adhesion = 2.22e-12f, .friction = 0.150f};
    const MicroimpactMotion motion = {.approach = 2.8f, .tangential = 0.5f};
    MicroimpactRigidScene scene;
    MicroimpactClassification result;
    MicroimpactError error;
    if (microimpact_rigid_init(&fitted, &scene, &error) != MICROIMPACT_STATUS_OK
        || microimpact_classify(&scene, &motion, &result, &error) != MICROIMPACT_STATUS_OK) {
        printf("parameter %u must be %g to %g\n", (unsigned)error.parameter, error.smallest, error.largest);
        return 1;
    }
    const char *class = result.impact_class == MICROIMPACT_CLASS_REBOUND_ROLLING ? "rebound rolling" : "another class";
    printf("%s %.3f\n", class, (double)result.speed_over_critical);
    return 0;
}
