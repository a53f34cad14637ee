% Answers requests, messages of numbers on standard input, with numbers on standard output; for GNU
% Octave. armdyn.ports says what a message holds. The arm is the one of model.m.

% Octave would go on with a least-squares solution and a warning.
warning('error', 'Octave:singular-matrix');
warning('error', 'Octave:nearly-singular-matrix');

arm_model = model();
while true
  count = fread(stdin, 1, 'double', 0, 'ieee-le');
  if isempty(count)
    break
  end
  request = fread(stdin, count, 'double', 0, 'ieee-le');
  if numel(request) < count
    break
  end
  if request(1) == 0
    answer = terms(arm_model, request(2:end));
  else
    answer = simulation(arm_model, request(2:end));
  end
  fwrite(stdout, 'numbers:');
  fwrite(stdout, [numel(answer); answer(:)], 'double', 0, 'ieee-le');
  fflush(stdout);
end
