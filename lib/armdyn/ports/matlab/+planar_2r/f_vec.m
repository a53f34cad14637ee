function value = f_vec(qd, arm)
%F_VEC  Friction of the joints of the planar 2R arm, viscous and Coulomb.
%   value = planar_2r.f_vec(qd, arm), 2 x 1, N m. At rest it is zero: there is no stiction.
%   qd   2 x 1, rad/s
%   arm  struct of the parameters: see planar_2r.dynamics
  value = arm.viscous(:).*qd + arm.coulomb(:).*sign(qd);
end
