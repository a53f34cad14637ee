function value = g_vec(q, arm)
%G_VEC  Gravity vector of the planar 2R arm, the gradient of its potential energy.
%   value = planar_2r.g_vec(q, arm), 2 x 1, N m.
%   q    2 x 1, rad
%   arm  struct of the parameters: see planar_2r.dynamics
  g2 = arm.m2*arm.lc2*arm.g*cos(q(1) + q(2));
  g1 = (arm.m1*arm.lc1 + arm.m2*arm.l1)*arm.g*cos(q(1)) + g2;
  value = [g1; g2];
end
