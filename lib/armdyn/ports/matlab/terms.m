function answer = terms(model, request)
%TERMS  M, C, g, f, the potential energy and qdd of each row of a request, a column for each row.
%   model    struct as model.m gives it
%   request  rows of the parameters, q, qd and u, one after the other
  n = model.n;
  rows = reshape(request, model.parameters + 3*n, []);
  answer = zeros(2*n^2 + 3*n + 1, size(rows, 2));
  for k = 1:size(rows, 2)
    arm = model.arm(rows(1:model.parameters, k));
    state = reshape(rows(model.parameters + 1:end, k), n, 3);
    q = state(:, 1);
    qd = state(:, 2);
    u = state(:, 3);
    M = model.M(q, arm);
    C = model.C(q, qd, arm);
    % Transposed, since a matrix is stored by columns and answered by rows.
    answer(:, k) = [reshape(M.', [], 1)
                    reshape(C.', [], 1)
                    model.g_vec(q, arm)
                    model.f_vec(qd, arm)
                    model.potential_energy(q, arm)
                    model.dynamics(q, qd, u, arm)];
  end
end
