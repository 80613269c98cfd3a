program one_cycle
  use, intrinsic :: iso_fortran_env, only: dp => real64
  use wear_tanh_rigid_bearing
  implicit none
  real(dp), parameter :: pi = acos(-1.0_dp), T = 0.06_dp, amplitude = 5.0e-4_dp
  real(dp), parameter :: R = 22.0_dp, speed = 2000.0_dp, slip_rate = R * speed * pi / 30.0_dp
  integer, parameter :: increments = 2000
  type(constants) :: c
  type(fields_type) :: state
  real(dp) :: u_c, sigma_c, half_step, middle
  integer :: i

  c = bind_constants(h_0=1.08e-3_dp, sigma_c0=3.6e-4_dp, f_c=0.25_dp, K_c=1.0e-6_dp, &
    H_c=200.0_dp, p_max=300.0_dp, R=R, n=speed)
  u_c = 0.0_dp
  sigma_c = 3.6e-4_dp
  do i = 1, increments
    middle = amplitude * sin(2.0_dp * pi * (real(i, dp) - 0.5_dp) / increments)
    half_step = 0.5_dp * T / increments * rate(u_c, middle, c)
    state = fields(u_c + half_step, middle, c)          ! stands in for the finite element code
    call wear_increment(state%p, slip_rate, T / increments, 1.0e-6_dp, 200.0_dp, 0.25_dp, &
      u_c, sigma_c)
  end do
  print '(a, es10.4, a)', 'wear after one cycle: ', u_c, ' mm'
end program one_cycle
