import microimpact as mi

body = mi.RigidBody(radius=5.06e-6, density=2600, restitution_speed=129, work_of_adhesion=2.22e-12, friction=0.150)
impact = body.classify(speed_normal=2.8, speed_tangential=0.5)
print(impact.class_name, round(float(impact.speed_over_critical), 3))
