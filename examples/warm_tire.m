% A tire warms up at 80 km/h: the C API of rollrig from MATLAB, which needs a C compiler once, for loadlibrary.
% Folders of the library and of its header, as after `cmake --install build/release --prefix /usr/local`:
library = '/usr/local/lib/x86_64-linux-gnu/librollrig.so';
header = '/usr/local/include/rollrig/c_api.h';
loadlibrary(library, header, 'alias', 'rollrig');

tire = calllib('rollrig', 'rollrig_wheel_create', 'a50', 'road');
if isNull(tire), error(calllib('rollrig', 'rollrig_last_error')); end
find = @(name) calllib('rollrig', 'rollrig_wheel_find_variable', tire, name);
check = @(status) assert(status == 0, calllib('rollrig', 'rollrig_last_error'));

check(calllib('rollrig', 'rollrig_wheel_start', tire, 0));
check(calllib('rollrig', 'rollrig_wheel_set', tire, find('speed_m_s'), 80 / 3.6));
fprintf('min  resistance N  liner degC\n');
value = libpointer('doublePtr', 0);
for minute = 0:10:30
  check(calllib('rollrig', 'rollrig_wheel_get', tire, find('rolling_resistance_N'), value));
  resistance_N = value.Value;
  check(calllib('rollrig', 'rollrig_wheel_get', tire, find('liner_temperature_K'), value));
  fprintf('%3d  %12.2f  %10.1f\n', minute, resistance_N, value.Value - 273.15);
  if minute < 30, check(calllib('rollrig', 'rollrig_wheel_step', tire, 600)); end
end
calllib('rollrig', 'rollrig_wheel_free', tire);
unloadlibrary('rollrig');
