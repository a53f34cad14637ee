%DEMO_2R  The terms of the equation of motion of a planar 2R arm, its structure, and its free motion.
%   Run it from the folder that holds +planar_2r, in MATLAB or in GNU Octave.

arm = struct('l1', 1.0, 'l2', 0.8, 'lc1', 0.5, 'lc2', 0.4, 'm1', 2.0, 'm2', 1.5, ...
             'I1', 0.17, 'I2', 0.08, 'g', 9.81, 'viscous', [0; 0], 'coulomb', [0; 0]);
q = [0.6; -1.1];
qd = [0.9; 1.7];

M = planar_2r.M(q, arm);
C = planar_2r.C(q, qd, arm);
fprintf('M = %s kg m^2\n', mat2str(M, 12));
fprintf('C = %s kg m^2/s\n', mat2str(C, 12));
fprintf('g = %s N m\n', mat2str(planar_2r.g_vec(q, arm), 12));
fprintf('P = %.12g J\n', planar_2r.potential_energy(q, arm));
fprintf('qdd = %s rad/s^2\n', mat2str(planar_2r.dynamics(q, qd, [1; -2], arm), 12));

% dM/dt along qd by a complex step, which loses no digits to a difference.
step = 1e-30;
M_dot = imag(planar_2r.M(q + 1i*step*qd, arm))/step;
N = M_dot - 2*C;
fprintf('largest entry of N + N'' for N = dM/dt - 2 C: %.3g\n', max(max(abs(N + N.'))));
assert(norm(N + N.') <= 1e-14*norm(N), 'dM/dt - 2 C is not skew-symmetric');

energy = @(x) 0.5*x(3:4)*planar_2r.M(x(1:2), arm)*x(3:4)' + planar_2r.potential_energy(x(1:2), arm);
[t, x] = planar_2r.simulate_ode45(arm, [q; qd], [0; 0], [0, 2]);
fprintf('free motion for %g s: q = %s rad\n', t(end), mat2str(x(end, 1:2), 9));
drift = energy(x(end, :)) - energy(x(1, :));
fprintf('its energy drifts by %.3g J\n', drift);
assert(abs(drift) < 1e-6, 'the energy of the free arm drifts');
