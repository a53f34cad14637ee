function answer = simulation(model, request)
%SIMULATION  States of the arm over time by the classical Runge-Kutta method, a column each.
%   model    struct as model.m gives it
%   request  the parameters, x0 = [q; qd], u (held), dt in s, and the number of steps; every
%            stride-th state, the last number, is answered
%   Source: W. Kutta (1901), Beitrag zur naeherungsweisen Integration totaler
%   Differentialgleichungen.
  n = model.n;
  arm = model.arm(request(1:model.parameters));
  given = request(model.parameters + 1:end);
  x = given(1:2*n);
  u = given(2*n + 1:3*n);
  dt = given(3*n + 1);
  steps = given(3*n + 2);
  stride = given(3*n + 3);

  dynamics = model.dynamics;
  rate = @(x) [x(n + 1:2*n); dynamics(x(1:n), x(n + 1:2*n), u, arm)];
  answer = zeros(2*n, floor(steps/stride) + 1);
  answer(:, 1) = x;
  for k = 1:steps
    k1 = rate(x);
    k2 = rate(x + dt/2*k1);
    k3 = rate(x + dt/2*k2);
    k4 = rate(x + dt*k3);
    x = x + dt/6*(k1 + 2*k2 + 2*k3 + k4);
    if mod(k, stride) == 0
      answer(:, k/stride + 1) = x;
    end
  end
end
