function qdd = dynamics(q, qd, u, arm)
%DYNAMICS  Accelerations of the planar 2R arm for given joint torques.
%   qdd = planar_2r.dynamics(q, qd, u, arm), 2 x 1, rad/s^2, solves
%   M(q) qdd + C(q, qd) qd + g(q) + f(qd) = u.
%   q    2 x 1, rad: angle of link 1 from the x axis, of link 2 from link 1
%   qd   2 x 1, rad/s
%   u    2 x 1, N m
%   arm  struct with the fields
%     l1, l2            lengths of the links, m
%     lc1, lc2          joint to centre of mass of each link, m
%     m1, m2            masses, kg
%     I1, I2            inertias about the centres of mass, kg m^2
%     g                 gravitational acceleration, m/s^2, along -y
%     viscous, coulomb  friction of the joints, 2 x 1 each, N m s/rad and N m
%   The backslash solves for the accelerations; no inverse of M is formed.
  rest = u - planar_2r.C(q, qd, arm)*qd - planar_2r.g_vec(q, arm) - planar_2r.f_vec(qd, arm);
  qdd = planar_2r.M(q, arm) \ rest;
end
