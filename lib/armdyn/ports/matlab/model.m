function value = model()
%MODEL  What the driver needs of the planar 2R arm: its size, its parameters and its functions.
  value.n = 2;
  value.parameters = 13;
  value.arm = @arm_of;
  value.M = @planar_2r.M;
  value.C = @planar_2r.C;
  value.g_vec = @planar_2r.g_vec;
  value.f_vec = @planar_2r.f_vec;
  value.potential_energy = @planar_2r.potential_energy;
  value.dynamics = @planar_2r.dynamics;
end

function arm = arm_of(p)
  arm = struct('l1', p(1), 'l2', p(2), 'lc1', p(3), 'lc2', p(4), 'm1', p(5), 'm2', p(6), ...
               'I1', p(7), 'I2', p(8), 'g', p(9), 'viscous', p(10:11), 'coulomb', p(12:13));
end
